// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/seen_scan.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/sweep_twist.hpp"
#include "beaconless/track/motion_filter.hpp"
#include "beaconless/track/odometry_track.hpp"

namespace beaconless {

/// How a robot moves during a sweep: as its poses and wheels tell, and as the sweep tells by being bent.
///
/// Motions are of the base, in its frame at the stamp. A sweep is fitted as it would be seen from where the
/// laser was at the stamp, by the motion so far, and once more where the fit tells another motion; what then
/// is not known of the motion is put into the covariance. Allocates nothing once buffers have grown.
class SweepMotion {
 public:
  /// `seen` and `odometry` are shared with who follows the robot, and outlive this.
  SweepMotion(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map, SeenScan& seen,
              const OdometryTrack& odometry);

  /// A new scan is at hand, of which nothing was told yet.
  void begin() { told_.reset(); }

  /// The motion during it by the poses so far, and by the wheels where they are trusted.
  ToldTwist expect(const Scan& scan, MotionFilter motion) const;

  /// Fits it again as long as the fit tells another motion than that by which it was seen, which is
  /// `prediction.motion`, and stays behind there. In: the fit, the poses before it. Cost: a fit, mostly.
  MatchResult refit(const MatchResult& first, Prediction& prediction, const Scan& scan,
                    const MotionFilter& motion);

  /// What the sweep itself told of the motion, if it had to.
  const std::optional<ToldTwist>& told() const { return told_; }

  /// What the motion adds to the error of a pose of the base, `is_moving_known` or not: all of it where the
  /// sweep is fitted as if seen at once; by how much it is not known where it is fitted by that motion.
  Eigen::Matrix3d covariance(const Pose2& map_from_base, const ToldTwist& motion, const Scan& scan,
                             bool is_moving_known) const;

  /// Whether a sweep that was seen without this motion is to be seen anew.
  bool is_bent_by(const ToldTwist& motion, const Scan& scan) const;

 private:
  ToldTwist tell(const MatchResult& match, const ToldTwist& assumed, const Scan& scan, MotionFilter motion);
  std::optional<ToldTwist> tell_by_bend(const MatchResult& match, const ToldTwist& assumed, const Scan& scan);

  std::shared_ptr<const SurfaceMap> map_;
  SeenScan* seen_;
  const OdometryTrack* odometry_;
  Pose2 base_from_laser_;
  Pose2 laser_from_base_;
  SweepNoise noise_;
  std::optional<ToldTwist> told_;
  std::vector<double> times_s_;  // of the points, after the stamp
};

}  // namespace beaconless
