// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/eval/errors.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::eval {

/// What a range scanner measures, as far as the accuracy that it allows is concerned.
struct RangeSensor {
  std::vector<double> angles_rad;
  double sigma_m = 0.01;  ///< standard deviation of a range
  double range_min_m = 0.1;
  double range_max_m = 30.0;
};

/// Hokuyo's UTM-30LX: 1081 beams over 270 deg.
RangeSensor utm_30lx(double sigma_m = 0.01);

/// The scanner that made a scan; sigma is not in the scan.
RangeSensor sensor_of(const Scan& scan, double sigma_m = 0.01);

/// The Fisher information of one scan about the laser's pose: 3x3, ordered x, y, theta along the map axes, in
/// 1/m², 1/(m·rad), 1/rad².
///
/// Beams that meet no wall within the range limits tell nothing, and neither do depth steps.
/// Source: Censi, "On achievable accuracy for range-finder localization", ICRA 2007: a beam u that meets a
/// wall of normal n at range r has dr/d(x, y, theta) = -(n/(n·u), r (n·u')/(n·u)), u' being u turned by 90
/// deg. Differs: beams within 0.06 deg of a wall's own direction (n·u below 1e-3) are left out; the wall ends
/// before the linearisation holds. Cost: a ray cast per beam.
Eigen::Matrix3d fisher_information(const RayCaster& walls, const RangeSensor& sensor,
                                   const Pose2& map_from_laser);

/// The Cramér–Rao bound, the least covariance of an unbiased estimate; nothing when a direction cannot be
/// observed.
std::optional<Eigen::Matrix3d> accuracy_bound(const Eigen::Matrix3d& information);

/// The bound of one scan for the pose of the base.
std::optional<Eigen::Matrix3d> accuracy_bound(const RayCaster& walls, const RangeSensor& sensor,
                                              const Pose2& map_from_base, const Pose2& base_from_laser);

/// The bound for the base at the reference of each error.
std::vector<std::optional<Eigen::Matrix3d>> accuracy_bounds(const RayCaster& walls, const RangeSensor& sensor,
                                                            const Pose2& base_from_laser,
                                                            std::span<const PoseError> errors);

/// How far errors lie above the bound: 1 cannot be beaten by an unbiased estimate from single scans.
struct CrbRatio {
  double position = 0.0;  ///< RMSE of the position over the root of the mean bound of var(x) + var(y)
  double heading = 0.0;   ///< the same of the heading

  friend bool operator==(const CrbRatio&, const CrbRatio&) = default;
};

/// Over the errors that have a bound; nothing when none has. In: one bound for each error.
std::optional<CrbRatio> crb_ratio(std::span<const PoseError> errors,
                                  std::span<const std::optional<Eigen::Matrix3d>> bounds);

}  // namespace beaconless::eval
