// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bridges/ros1/complaints.hpp"
#include "bridges/ros1/link.hpp"
#include "bridges/ros1/localization.hpp"
#include "bridges/ros1/mounted_laser.hpp"
#include "bridges/ros1/pose_memory.hpp"
#include "bridges/ros1/settings.hpp"
#include "bridges/ros1/stamp_watch.hpp"
#include "bridges/ros1/tf_rivals.hpp"

namespace beaconless::ros1 {

/// What a robot hears, brought to a localizer, and what that says, told: everything of the node but ROS.
///
/// A scan waits a little for its transforms, and those behind it wait with it, so that the order is kept.
/// Total: whatever is heard, in any order, gives words in /diagnostics and never an identity for a transform
/// that is missing.
class Node {
 public:
  Node(const Settings& settings, Link& link, Localization::Maker maker = make_localizer);

  /// The node as the link sees it; it must outlive those.
  Handlers handlers();

  /// A map from a file, which is sent for others to see. Errors: those of make_localizer and message_of_map.
  Result<Done> set_map(Map map, const io::MapIdentity& identity);

  void hear_scan(const ScanMessage& scan);
  void hear_initial_pose(const PoseMessage& pose);
  void hear_map(const GridMessage& grid);
  void hear_new_master();
  void hear_transform_of_other(const TransformMessage& told, const std::string& teller, bool is_static);
  Answer serve_set_map(const GridMessage& grid, const PoseMessage& pose);
  Answer serve_global_localization();
  Answer serve_nomotion_update() const;
  Answer serve_save_pose();
  void tick();

 private:
  static constexpr double kRemember_s = 10.0;  // how long a thing of a moment stays in the diagnostics

  struct Waiting {
    ScanMessage message;
    double since_s = 0.0;
    std::optional<Scan> scan;  // as soon as the laser is known
  };
  enum class Step { done, wait };
  /// A laser, as soon as it is heard; it sits somewhere, as soon as that is known.
  struct Laser {
    std::optional<MountedLaser> mounted;
    bool was_waited_for = false;  // for tf to tell where it sits
  };
  /// Where the base is in the frame of the wheels, as far as that is known.
  struct Wheels {
    Step step = Step::done;
    std::optional<Pose2> odom_from_base;
  };

  void start();
  void look_after_scans(double now_s);
  void miss_map();
  bool check_stamp(const ScanMessage& scan);
  void drain();
  Step take(Waiting& waiting);
  Step find_laser(const Waiting& waiting);
  Step use_lasers();
  Result<Done> mount(const std::string& frame, const Transform& base_from_laser);
  bool make_scan(Waiting& waiting);
  Wheels find_wheels(const Waiting& waiting);
  void localize(const Scan& scan, const std::optional<Pose2>& odom_from_base);
  void tell(const std::optional<PoseEstimate>& before, const PoseEstimate& estimate, const Scan& scan,
            const std::optional<Pose2>& odom_from_base);
  void tell_tf(const PoseEstimate& estimate, const std::optional<Pose2>& odom_from_base);
  bool is_known(const PoseEstimate& estimate) const;
  void log_change(const PoseEstimate& estimate);
  void search_everywhere();
  void grow_path(const PoseEstimate& estimate);
  Result<Done> use_map(Map map, const io::MapIdentity& identity);
  Result<Done> take_grid(OccupancyGrid grid, const std::string& frame);
  void complain(const std::string& subject, Level level, const std::string& words,
                double lasts_s = Complaints::kForGood);

  NodeConfig config_;
  bool has_initial_pose_;
  bool has_base_from_laser_;
  Link& link_;
  Localization localization_;
  PoseMemory memory_;
  Complaints complaints_;
  TfRivals tf_rivals_;
  std::optional<PoseMessage> early_pose_;     // heard before there was a map
  std::map<std::string, StampWatch> stamps_;  // by the frames of the scans
  std::deque<Waiting> waiting_;
  std::map<std::string, Laser> lasers_;  // by the frames of their scans
  bool are_lasers_new_ = false;          // and the localizer does not know of them
  std::optional<double> first_heard_s_;  // a scan
  std::optional<Stamp> first_scan_;      // by its own clock
  std::optional<Stamp> last_wheels_;     // that were told on
  bool has_seen_wheels_ = false;
  std::map<std::string, double> heard_s_;  // when, by the frames of the scans that are used
  double begun_s_;
  std::int64_t last_tf_ns_ = 0;
  double last_told_s_ = 0.0;
  PosesMessage path_;
  bool is_path_new_ = false;
  std::uint64_t scans_heard_ = 0;
  std::uint64_t scans_dropped_ = 0;
  std::optional<bool> was_found_;  // as the log has it, since it was last told where to start
  double longest_ms_ = 0.0;        // from a scan's arrival to its pose, since the last diagnostic
};

}  // namespace beaconless::ros1
