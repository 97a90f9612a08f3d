// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/pose_fusion.hpp"

#include <Eigen/Cholesky>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {

PoseOpinion fused(const PoseOpinion& a, const PoseOpinion& b) {
  const Eigen::Matrix3d information = information_of(a.covariance) + information_of(b.covariance);
  const Eigen::Matrix3d covariance = symmetric(symmetric(information).inverse());
  const Eigen::Vector3d step = covariance * information_of(b.covariance) * way_between(a.pose, b.pose);
  return {stepped(a.pose, step), covariance};
}

double squared_distance(const PoseOpinion& a, const PoseOpinion& b) {
  const Eigen::Matrix3d both = a.covariance + b.covariance;
  const Eigen::Vector3d way = way_between(a.pose, b.pose);
  return way.dot(both.ldlt().solve(way));
}

}  // namespace beaconless
