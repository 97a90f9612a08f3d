// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace beaconless {

/// The covariance of two independent opinions on one pose, the first of which may know nothing along some
/// direction.
///
/// In: 3x3, ordered x, y, theta, positive semidefinite; `with_open_directions` up to 1e6 along what it does
/// not know. Out: symmetric, no direction with a negative variance. Information adds up direction by
/// direction; inverting the sum of matrices that hold 1e6 m² beside 1e-8 m² loses all digits of the small
/// ones.
Eigen::Matrix3d fused_covariance(const Eigen::Matrix3d& with_open_directions, const Eigen::Matrix3d& other);

/// A covariance without what rounding made of its symmetry.
inline Eigen::Matrix3d symmetric(const Eigen::Matrix3d& m) { return 0.5 * (m + m.transpose()); }

}  // namespace beaconless
