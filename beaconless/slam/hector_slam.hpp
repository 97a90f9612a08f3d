// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "beaconless/event.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/slam/fit_judge.hpp"
#include "beaconless/slam/growing_map.hpp"
#include "beaconless/slam/hector_slam_config.hpp"

namespace beaconless {

/// HectorSLAM: finds the robot in the map that its own earlier scans made, with the laser alone.
///
/// The first scan that hits something begins the map; the map's frame is that of the start pose. Each scan is
/// matched with the map so far (match_hector), and drawn into it once the robot has moved. There is no
/// closing of loops: what drifted on the way round stays. A pose's covariance is relative to the map as it is
/// there, not to the start.
///
/// Status: `degraded` where walls in view leave a direction open, where little of the scan lies on what is
/// known, or where it contradicts the map; scans that are not held are not drawn. `lost` after many of those
/// in a row. Cost of a scan: a match; a search (about a millisecond) in doubt; drawing every 0.4 m.
///
/// Source: Kohlbrecher, von Stryk, Meyer, Klingauf, "A flexible and scalable SLAM system with full 3D motion
/// estimation", SSRR 2011; dissertation 2.4.2 and 3.3.2.
/// Differs: (1) matches start from where the robot should be by its motion so far, there from the last pose;
/// (2) where the match explains unusually little, poses around are searched (Olson 2009), because a robot
/// that turns by 20 degrees between two scans is outside the matcher's basin; (3) a match that fits badly
/// moves neither the robot nor the map; (4) see match_hector, GrowingMap.
class HectorSlam {
 public:
  /// Errors: a value of the config that is not allowed; a start pose that is not finite or beyond 1e5 m.
  static Result<HectorSlam> make(const HectorSlamConfig& config = {}, const Pose2& map_from_base = {});

  PoseEstimate update(const Event& event);

  /// The finest level of the map, see LogOddsGrid::grid().
  OccupancyGrid grid() const { return map_.grid(); }

  const GrowingMap& map() const { return map_; }

 private:
  HectorSlam(const HectorSlamConfig& config, const Pose2& map_from_base);

  void load(const Scan& scan);
  PoseEstimate begin(const Scan& scan);
  Prediction predict(Stamp stamp) const;
  SlamReach reach_at(Stamp stamp) const;
  SlamFit fit_from(const Pose2& map_from_laser);
  Pose2 correction(const SlamFit& fit, const Prediction& prediction) const;
  double worth(const SlamFit& fit, const Prediction& prediction, const SlamReach& reach) const;
  bool is_worth_searching(double worth, const SlamFit& fit) const;
  SlamFit search(const SlamFit& first, const Prediction& prediction, const SlamReach& reach);
  PoseEstimate accept(const SlamFit& fit, const Prediction& prediction, const SlamReach& reach, Stamp stamp);
  PoseEstimate coast(const SlamFit& fit, const Prediction& prediction, Stamp stamp, std::string_view reason);
  bool draw_if_moved(const Scan& scan);

  HectorSlamConfig config_;
  Pose2 laser_from_base_;
  GrowingMap map_;
  MotionFilter motion_;
  FitJudge judge_;
  PoseEstimate last_;
  Stamp held_at_;                           ///< of the last scan whose fit was taken
  int not_held_in_a_row_ = 0;               ///< scans since
  Pose2 drawn_at_;                          ///< the base, when a scan was last drawn
  std::optional<Pose2> odom_from_base_;     ///< latest
  std::optional<Pose2> odom_of_last_scan_;  ///< as it was then
  HectorScratch match_scratch_;
  PyramidSearchScratch search_scratch_;
  std::vector<FoundPose> found_;
  std::vector<Eigen::Vector2d> points_;  ///< of the scan that can be matched, laser frame
  std::vector<BeamWay> ways_;
};

}  // namespace beaconless
