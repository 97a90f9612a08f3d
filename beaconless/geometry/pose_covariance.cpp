// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/pose_covariance.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace beaconless {

Eigen::Matrix3d information_of(const Eigen::Matrix3d& covariance) {
  constexpr double kLeast = 1e-10;  // what rounding leaves of a variance beside 1e6
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> opinion(covariance);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d way = opinion.eigenvectors().col(k);
    information += way * way.transpose() / std::max(opinion.eigenvalues()[k], kLeast);
  }
  return symmetric(information);
}

Eigen::Matrix3d fused_covariance(const Eigen::Matrix3d& with_open_directions, const Eigen::Matrix3d& other) {
  constexpr double kRidge = 1e-12;
  const Eigen::Matrix3d information = (other + kRidge * Eigen::Matrix3d::Identity()).inverse();
  return symmetric(symmetric(information + information_of(with_open_directions)).inverse());
}

}  // namespace beaconless
