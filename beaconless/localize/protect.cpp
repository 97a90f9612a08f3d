// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/protect.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {

void protect(PoseEstimate& estimate, const MatchResult& fit, const Pose2& laser_from_base, double risk,
             bool is_elsewhere) {
  estimate.protection_m = PoseEstimate::kUnbounded_m;
  estimate.protection_rad = kPi;
  const bool is_somewhere = estimate.status == Status::ok || estimate.status == Status::degraded;
  if (!is_somewhere || is_elsewhere || !fit.protection.is_bounded()) return;
  // A base beside the laser moves where the heading turns.
  const double lever_m = laser_from_base.translation().norm();
  const Eigen::Matrix3d more =
      estimate.covariance - moved_covariance(fit.covariance, fit.map_from_laser, laser_from_base);
  const double sigmas = protection_sigmas(risk);
  const double position_m = fit.protection.position_m + lever_m * fit.protection.heading_rad +
                            sigmas * std::sqrt(std::max(0.0, more(0, 0) + more(1, 1)));
  const double heading_rad = fit.protection.heading_rad + sigmas * std::sqrt(std::max(0.0, more(2, 2)));
  if (!(position_m < PoseEstimate::kUnbounded_m) || !(heading_rad < kPi)) return;
  estimate.protection_m = position_m;
  estimate.protection_rad = heading_rad;
}

}  // namespace beaconless
