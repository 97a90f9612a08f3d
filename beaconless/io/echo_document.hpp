// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/core/stamp.hpp"
#include "beaconless/event.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// What kind of message a block of echoed text is.
enum class EchoKind { nothing, scan, odometry, pose, other };

/// One message of `rostopic echo` or `ros2 topic echo`: the lines between two `---`, taken one at a time.
///
/// Scalars are kept under their full name ("header.stamp.secs"); of the arrays only `ranges` and
/// `intensities`.
class EchoDocument {
 public:
  static constexpr const char* kDelimiter = "---";

  void take(std::string_view line);
  void clear() { *this = EchoDocument(); }

  EchoKind kind() const;
  bool is_ros2() const { return scalars_.contains("header.stamp.nanosec"); }
  bool is_abridged() const { return abridged_; }  ///< arrays were left out or cut short by the one who echoed
  bool is_whole() const { return whole_; }        ///< the last line of a scan, its intensities, was met

  /// Errors (without path and line): a field that is missing or no number, an array that is not closed or was
  /// cut.
  Result<RawScan> scan() const;
  Result<Odometry> odometry() const;   ///< nav_msgs/Odometry
  Result<ReferencePose> pose() const;  ///< geometry_msgs/PoseStamped and PoseWithCovarianceStamped

 private:
  enum class Array { none, ranges, intensities };
  struct Level {
    std::size_t indent;
    std::string name;
  };

  std::string full_name(std::size_t indent, std::string_view key);
  void take_value(const std::string& name, std::string_view value);
  void take_items(std::string_view items);
  void take_item(Array array, std::string_view item);
  Result<double> number(const std::string& name) const;
  Result<Stamp> stamp() const;
  Result<Pose2> planar_pose(const std::string& prefix) const;

  std::vector<Level> levels_;
  std::map<std::string, std::string, std::less<>> scalars_;
  std::vector<float> ranges_;
  std::vector<float> intensities_;
  Array open_bracket_ = Array::none;  ///< a `[` whose `]` has not come yet
  Array open_list_ = Array::none;     ///< a key whose items follow, `- item` on each line
  bool has_ranges_ = false;
  bool whole_ = false;
  bool abridged_ = false;
  bool any_ = false;
  std::string fault_;
};

}  // namespace beaconless::io
