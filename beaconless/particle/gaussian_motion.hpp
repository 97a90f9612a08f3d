// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/particle/particles.hpp"

namespace beaconless {

/// Moves every particle by a motion (base before to base after) that is known to a covariance, each with an
/// error of its own: what a recording without odometry has, where the motion is that of the last scans
/// carried on.
///
/// In: the covariance of (x, y, theta) of the motion, in the axes of the base before it; positive
/// semidefinite. Cost: three normal draws a particle.
void move_by_gaussian(const Pose2& motion, const Eigen::Matrix3d& covariance, Rng& rng, Particles& particles);

}  // namespace beaconless
