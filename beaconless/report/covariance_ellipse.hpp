// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace beaconless::report {

/// Where a Gaussian in the plane has fallen to so many sigmas.
struct Ellipse {
  double major_m = 0.0;    ///< longer half axis
  double minor_m = 0.0;    ///< shorter half axis
  double angle_rad = 0.0;  ///< of the longer one, counter-clockwise from x
};

/// The ellipse of a 2x2 covariance in m²; all zero when that is not finite.
///
/// Source: the closed form of the eigenvalues of a symmetric 2x2 matrix; negative ones count as 0.
inline Ellipse covariance_ellipse(const Eigen::Matrix2d& covariance, double sigma_count = 1.0) {
  if (!covariance.allFinite()) return {};
  const double middle = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  const double off = 0.5 * (covariance(0, 1) + covariance(1, 0));
  const double radius = std::hypot(half_difference, off);
  return {sigma_count * std::sqrt(std::max(middle + radius, 0.0)),
          sigma_count * std::sqrt(std::max(middle - radius, 0.0)), 0.5 * std::atan2(off, half_difference)};
}

}  // namespace beaconless::report
