// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// A pose as somebody knows it.
struct PoseOpinion {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< x, y, theta, along the axes the pose is given in
};

/// What two independent opinions on one pose tell together: their mean, each weighted by its information.
///
/// Either may know nothing along some direction (a variance up to 1e6 there), but not both along the same.
/// Cost: two symmetric 3x3 eigenproblems. Source: the best linear unbiased estimate. Differs: the difference
/// of both poses is taken along the axes, which is right for small turns between them.
PoseOpinion fused(const PoseOpinion& a, const PoseOpinion& b);

/// How far two opinions are apart: the squared Mahalanobis distance, which is that of chi-square with three
/// degrees of freedom where both are right.
double squared_distance(const PoseOpinion& a, const PoseOpinion& b);

}  // namespace beaconless
