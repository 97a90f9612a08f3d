// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/pose_covariance.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace beaconless {
namespace {

/// Sure of everything but one direction, which mixes metres and radians.
Eigen::Matrix3d open_along(const Eigen::Vector3d& way, double sigma) {
  const Eigen::Vector3d unit = way.normalized();
  return sigma * sigma * Eigen::Matrix3d::Identity() + 1e6 * unit * unit.transpose();
}

TEST(FusedCovariance, OfTwoGoodOpinionsIsTheInverseOfTheirInformation) {
  const Eigen::Matrix3d a = Eigen::Vector3d(0.04, 0.01, 0.001).asDiagonal();
  Eigen::Matrix3d b = Eigen::Vector3d(0.01, 0.03, 0.002).asDiagonal();
  b(0, 1) = b(1, 0) = 0.005;
  EXPECT_TRUE(fused_covariance(a, b).isApprox((a.inverse() + b.inverse()).inverse(), 1e-6));
}

TEST(FusedCovariance, AnOpenDirectionIsTheOthersAndTheRestIsBetter) {
  const Eigen::Vector3d way(0.0, 1.0, 0.0);
  const Eigen::Matrix3d other = 0.01 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d fused = fused_covariance(open_along(way, 0.001), other);
  EXPECT_NEAR(fused(1, 1), 0.01, 1e-6);
  EXPECT_LT(fused(0, 0), 1.1e-6);
  EXPECT_LT(fused(2, 2), 1.1e-6);
}

/// Fused again and again, as in a corridor: nothing grows, nothing turns negative.
TEST(FusedCovariance, StaysACovarianceOverManyScans) {
  Eigen::Matrix3d belief = 0.01 * Eigen::Matrix3d::Identity();
  for (int scan = 0; scan < 500; ++scan) {
    const double turn = 0.05 * scan;
    const Eigen::Vector3d way(std::cos(turn), std::sin(turn), 0.3 * std::sin(3.0 * turn));
    belief = fused_covariance(open_along(way, 3e-5), belief + 1e-5 * Eigen::Matrix3d::Identity());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(belief);
    ASSERT_GT(solver.eigenvalues()[0], 0.0) << scan;
    ASSERT_LT(solver.eigenvalues()[2], 0.02) << scan;
  }
}

}  // namespace
}  // namespace beaconless
