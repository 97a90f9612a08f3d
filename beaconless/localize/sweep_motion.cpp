// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/sweep_motion.hpp"

#include <cmath>
#include <utility>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {
namespace {

// Of what half a sweep misplaces beams by:
constexpr double kSkew_m = 2e-4;  // less than both is not worth a second fit
constexpr double kSkew_rad = 1e-4;
constexpr double kUnsure_m = 1e-3;  // what is uncertain by less than both need not be told by the sweep
constexpr double kUnsure_rad = 1e-3;
constexpr double kBent_m = 0.01;  // more than one of these is seen anew
constexpr double kBent_rad = radians(0.2);
constexpr int kMostRepeats = 4;  // of a fit: one is the rule, more at a start in full motion

/// The fit of a sweep is right for some moment of it, half of it from the stamp on average.
double half_s(const Scan& scan) { return 0.5 * scan.sweep_time_s(); }

}  // namespace

SweepMotion::SweepMotion(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map, SeenScan& seen,
                         const OdometryTrack& odometry)
    : map_(std::move(map)),
      seen_(&seen),
      odometry_(&odometry),
      base_from_laser_(config.base_from_laser),
      laser_from_base_(config.base_from_laser.inverse()) {
  const bool is_walls = config.method == "walls";
  noise_.sigma_m = is_walls ? config.walls.sigma_m : config.icp.sigma_m;
  noise_.map_sigma_m = is_walls ? config.walls.map_sigma_m : config.icp.map_sigma_m;
}

ToldTwist SweepMotion::expect(const Scan& scan, MotionFilter motion) const {
  const auto told = odometry_->between(scan.stamp(), scan.stamp() + scan.sweep_time_s());
  if (told && odometry_->is_trusted()) motion.hear(*told, scan.sweep_time_s());
  return motion.motion_at(scan.stamp());
}

MatchResult SweepMotion::refit(const MatchResult& first, Prediction& prediction, const Scan& scan,
                               const MotionFilter& motion) {
  MatchResult match = first;
  for (int again = 0; again < kMostRepeats && seen_->is_unbent(scan) && match.rank == 3; ++again) {
    // 1. The motion, now that the pose is known.
    const ToldTwist assumed = std::exchange(prediction.motion, tell(match, prediction.motion, scan, motion));
    // 2. Once more by it, if it is another one.
    const Eigen::Vector3d skew = half_s(scan) * (prediction.motion.per_s - assumed.per_s);
    if (skew.head<2>().norm() < kSkew_m && std::abs(skew.z()) < kSkew_rad) break;
    seen_->see(scan, prediction.motion, match.map_from_laser,
               match.covariance + Eigen::Matrix3d(skew.cwiseAbs2().asDiagonal()));
    const MatchResult next = seen_->fit_from(match.map_from_laser);
    if (!next.usable()) break;
    match = next;
  }
  return match;
}

/// The motion by the poses with this one, and by how the sweep is bent where that is uncertain.
ToldTwist SweepMotion::tell(const MatchResult& match, const ToldTwist& assumed, const Scan& scan,
                            MotionFilter motion) {
  motion.correct(scan.stamp(), match.map_from_laser * laser_from_base_,
                 moved_covariance(match.covariance, match.map_from_laser, laser_from_base_));
  ToldTwist by_poses = expect(scan, motion);
  const bool is_unsure =
      half_s(scan) * std::sqrt(by_poses.covariance.topLeftCorner<2, 2>().trace()) > kUnsure_m ||
      half_s(scan) * std::sqrt(by_poses.covariance(2, 2)) > kUnsure_rad;
  if (!is_unsure) return by_poses;
  told_ = tell_by_bend(match, assumed, scan);
  return told_ && motion.hear(*told_, scan.sweep_time_s()) ? expect(scan, motion) : by_poses;
}

std::optional<ToldTwist> SweepMotion::tell_by_bend(const MatchResult& match, const ToldTwist& assumed,
                                                   const Scan& scan) {
  times_s_.clear();
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam)) times_s_.push_back(scan.beam_time_s(beam));
  const SweepNoise noise{noise_.sigma_m, noise_.map_sigma_m, match.scale_m};
  const auto bent = twist_of_sweep(seen_->points(), times_s_, *map_, match.map_from_laser, noise);
  if (!bent) return std::nullopt;
  const Eigen::Matrix3d to_base = base_from_laser_.adjoint();
  return ToldTwist{assumed.per_s + to_base * bent->correction_per_s,
                   to_base * bent->covariance * to_base.transpose()};
}

Eigen::Matrix3d SweepMotion::covariance(const Pose2& map_from_base, const ToldTwist& motion, const Scan& scan,
                                        bool is_moving_known) const {
  const Eigen::Matrix3d to_map = turn_of(map_from_base);
  Eigen::Matrix3d unknown = half_s(scan) * half_s(scan) * to_map * motion.covariance * to_map.transpose();
  if (seen_->is_unbent(scan) || !is_moving_known) return unknown;
  const Eigen::Vector3d error = to_map * (half_s(scan) * motion.per_s);
  return error * error.transpose();
}

bool SweepMotion::is_bent_by(const ToldTwist& motion, const Scan& scan) const {
  const Eigen::Vector3d skew = half_s(scan) * motion.per_s;
  return seen_->is_unbent(scan) && (skew.head<2>().norm() > kBent_m || std::abs(skew.z()) > kBent_rad);
}

}  // namespace beaconless
