// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/particle/amcl_config.hpp"
#include "beaconless/particle/particles.hpp"

namespace beaconless {

/// A motion as wheels tell it, and how far each part of it is off (standard deviations; m, rad).
struct OdometryStep {
  double turn1_rad = 0.0;  ///< to where the robot drives; omni: the direction of the way
  double way_m = 0.0;      ///< negative backwards
  double turn2_rad = 0.0;  ///< at its end; omni: the whole turn
  double turn1_sigma_rad = 0.0;
  double way_sigma_m = 0.0;
  double turn2_sigma_rad = 0.0;
  double side_sigma_m = 0.0;  ///< omni: across the way
  bool is_omni = false;
};

/// Takes a motion (base before to base after) apart. Source: Thrun et al., 5.4 and table 5.6; omni after
/// ROS's amcl. Differs: a robot that drives backwards has a negative way instead of two half turns, so that
/// both directions have the same noise and the same mean.
OdometryStep odometry_step(const Pose2& motion, const AmclConfig& config);

/// Moves every particle by it, each with errors of its own. Cost: three normal draws a particle.
void move_by_odometry(const OdometryStep& step, Rng& rng, Particles& particles);

/// The covariance (x, y, theta, map axes) of where such a motion ends, to first order. In: where it begins
/// and how sure that is.
Eigen::Matrix3d moved_by_odometry(const Eigen::Matrix3d& covariance, const Pose2& map_from_base,
                                  const OdometryStep& step);

}  // namespace beaconless
