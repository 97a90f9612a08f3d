// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "beaconless/event.hpp"
#include "beaconless/io/raw_from.hpp"
#include "beaconless/scan/raw_scan.hpp"

namespace beaconless::io {

/// Writes a CARMEN log as events come; gzip when the path ends in ".gz".
///
/// All numbers read back as the very same floats. What a laser line has no room for (range_min, times, frame,
/// place) goes into PARAM lines `beaconless_laser_…` where it changes; other programs pass over them.
class CarmenWriter {
 public:
  /// Opens the file; a path that cannot be written shows in `good()`. Each line of `comment` becomes a
  /// comment.
  explicit CarmenWriter(const std::string& path, std::string_view comment = {});

  /// A sweep without a pose: RAWLASER1. Keep to one form within a file, or readers ask which to take.
  void write(const RawScan& scan);
  /// A sweep with the robot's pose: ROBOTLASER1.
  void write(const RawScan& scan, const Pose2& map_from_base, const Pose2& base_from_laser = {});
  /// As above, for a scan behind the gate; see raw_from.
  void write(const Scan& scan);
  void write(const Scan& scan, const Pose2& map_from_base, const Pose2& base_from_laser = {});
  void write(const Odometry& odometry);        ///< ODOM
  void write(const ReferencePose& reference);  ///< TRUEPOS, without base_from_laser

  /// Where the laser sits, for sweeps without a pose: a PARAM line with the first of them. The first place
  /// stays.
  void place_laser(const Pose2& base_from_laser);

  /// Writes what is left and closes the file; false when anything could not be written. Called on destruction
  /// too.
  bool close();
  bool good() const { return good_; }

 private:
  struct Close {
    void operator()(void* gz_file) const;
  };

  void put(const std::string& text);
  void put_params(const RawScan& scan);
  void put_scan(const char* keyword, const RawScan& scan, const std::string& poses);

  std::unique_ptr<void, Close> file_;
  bool good_ = false;
  std::optional<Pose2> base_from_laser_;
  bool is_place_put_ = false;
  RawScan last_;  ///< its ranges stay empty: what the PARAM lines have said so far
};

}  // namespace beaconless::io
