// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// How far a beam is to be believed.
struct SweepNoise {
  double sigma_m = 0.01;     ///< of a range
  double map_sigma_m = 0.0;  ///< of the walls; it is the same for all beams of a wall
  double scale_m = 0.0;      ///< what the residuals scatter by, where it is more
};

/// By how much the motion during a sweep was another than was assumed.
struct SweepTwist {
  Eigen::Vector3d correction_per_s =
      Eigen::Vector3d::Zero();  ///< twist of the laser, in its frame at the stamp
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// What a sweep tells of the motion during it by being bent against the walls, whatever the pose.
///
/// In: ends of beams as seen from where the laser was at the stamp by the twist assumed; the time of each
/// after the stamp (s); the pose that was fitted. Nothing where the beams that lie on walls are too few, or
/// came all at once. Cost: one nearest look-up a beam. Source: pose and twist by one Gauss-Newton step on the
/// distances to the walls (six unknowns), the pose eliminated by the Schur complement.
/// The covariance is honest for corrections that move beams by no more than a range's noise; larger ones are
/// near, and told well by a step more.
std::optional<SweepTwist> twist_of_sweep(std::span<const Eigen::Vector2d> points,
                                         std::span<const double> times_s, const SurfaceMap& map,
                                         const Pose2& map_from_laser, const SweepNoise& noise);

}  // namespace beaconless
