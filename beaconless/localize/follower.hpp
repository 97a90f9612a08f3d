// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/match_judge.hpp"
#include "beaconless/localize/other_starts.hpp"
#include "beaconless/localize/rivals.hpp"
#include "beaconless/localize/seen_scan.hpp"
#include "beaconless/localize/shaken.hpp"
#include "beaconless/localize/sweep_motion.hpp"
#include "beaconless/localize/trust.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/pose_estimate.hpp"
#include "beaconless/track/motion_filter.hpp"
#include "beaconless/track/odometry_track.hpp"

namespace beaconless {

/// Follows a robot whose place is known from scan to scan: predicts, lets a ScanMatcher fit the scan, and
/// judges what came of it.
///
/// Source: dissertation 3.2 and 3.3; prediction from the last poses. Differs: sweeps are fitted by the motion
/// during them (SweepMotion); a fit that is hard to believe is tried again from elsewhere (OtherStarts), and
/// where a matcher of features gets nowhere from there either, the whole scan stands in for it and the status
/// is degraded.
class Follower {
 public:
  /// `seen`, `sweep` and `odometry` are shared with who looks for the robot, and outlive this.
  Follower(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map, SeenScan& seen,
           SweepMotion& sweep, OdometryTrack& odometry);
  Follower(const Follower&) = delete;  // its parts share the rest of them
  Follower& operator=(const Follower&) = delete;

  /// The base is about here now; all that was known before is forgotten.
  void start_at(const Pose2& map_from_base);

  /// Takes in the next scan. Cost: a fit or two as a rule, more where the fit is hard to believe; nothing is
  /// allocated once buffers have grown.
  PoseEstimate follow(const Scan& scan);

  /// Whether the robot is lost, and the last scan does not fit where it is believed to be either.
  bool is_adrift() const;

  /// Whether beams pass through walls of the map where the robot is believed to be.
  bool is_through_walls() const { return is_through_walls_; }

  /// Whether other places nearby fit about as well, and are followed beside.
  bool has_rivals() const { return rivals_.any(); }

  /// What puts the place in doubt.
  Shaken& shaken() { return shaken_; }

 private:
  Prediction predict(const Scan& scan);
  std::string_view caveat_of(const MatchResult& match, bool is_other) const;
  PoseEstimate accept(const MatchResult& match, const Prediction& prediction, const Scan& scan,
                      std::string_view reservation);
  PoseEstimate stand_in(const MatchResult& whole_scan, const Prediction& prediction, const Scan& scan);
  PoseEstimate coast(const Prediction& prediction, Stamp stamp, std::string_view reason);

  std::shared_ptr<const SurfaceMap> map_;
  SeenScan* seen_;
  SweepMotion* sweep_;
  OdometryTrack* odometry_;
  Pose2 base_from_laser_;
  Pose2 laser_from_base_;
  double risk_;         // of a protection level
  double map_sigma_m_;  // by how much walls may be off
  MotionFilter motion_;
  Rivals rivals_;
  MatchJudge judge_;
  OtherStarts others_;
  Trust trust_;
  Shaken shaken_;
  Pose2 last_;  // map_from_base
  std::optional<Stamp> last_scan_;
  double explained_ = 0.0;   // share of the last scan
  int surprised_scans_ = 0;  // that are still to agree after a jump
  bool is_through_walls_ = false;
};

}  // namespace beaconless
