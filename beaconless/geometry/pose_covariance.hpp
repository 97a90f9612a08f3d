// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// The inverse of a covariance that may hold 1e6 m² beside 1e-8 m², direction by direction. Symmetric.
Eigen::Matrix3d information_of(const Eigen::Matrix3d& covariance);

/// The covariance of two independent opinions on one pose, the first of which may know nothing along some
/// direction.
///
/// In: 3x3, ordered x, y, theta, positive semidefinite; `with_open_directions` up to 1e6 along what it does
/// not know. Out: symmetric, no direction with a negative variance. Information adds up direction by
/// direction; inverting the sum of matrices that hold 1e6 m² beside 1e-8 m² loses all digits of the small
/// ones.
Eigen::Matrix3d fused_covariance(const Eigen::Matrix3d& with_open_directions, const Eigen::Matrix3d& other);

/// Turns (x, y, theta) from the axes of a pose to those that the pose is given in; its transpose turns back.
inline Eigen::Matrix3d turn_of(const Pose2& pose) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = pose.rotation();
  return turn;
}

/// From one pose to another as (x, y, theta) along the axes that both are given in, the shorter way round.
inline Eigen::Vector3d way_between(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.theta_rad - from.theta_rad)};
}

/// A covariance without what rounding made of its symmetry.
inline Eigen::Matrix3d symmetric(const Eigen::Matrix3d& m) { return 0.5 * (m + m.transpose()); }

}  // namespace beaconless
