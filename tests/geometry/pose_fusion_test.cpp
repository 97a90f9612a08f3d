// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/pose_fusion.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

PoseOpinion opinion(const Pose2& pose, const Eigen::Vector3d& variances) {
  return {pose, variances.asDiagonal()};
}

TEST(PoseFusion, OfTwoEquallySureIsHalfWay) {
  const PoseOpinion both =
      fused(opinion({1.0, 2.0, 0.1}, {0.01, 0.01, 0.01}), opinion({1.2, 2.0, 0.3}, {0.01, 0.01, 0.01}));
  EXPECT_NEAR(both.pose.x_m, 1.1, 1e-12);
  EXPECT_NEAR(both.pose.theta_rad, 0.2, 1e-12);
  EXPECT_TRUE(both.covariance.isApprox(0.005 * Eigen::Matrix3d::Identity(), 1e-9));
}

TEST(PoseFusion, TheSurerCountsMoreAlongEachDirection) {
  const PoseOpinion both =
      fused(opinion({0.0, 0.0, 0.0}, {1e6, 0.01, 0.01}), opinion({1.0, 1.0, 0.0}, {0.01, 0.03, 0.01}));
  EXPECT_NEAR(both.pose.x_m, 1.0, 1e-6);
  EXPECT_NEAR(both.pose.y_m, 0.25, 1e-9);
}

TEST(PoseFusion, HeadingsMeetTheShorterWayRound) {
  const PoseOpinion both = fused(opinion({0.0, 0.0, kPi - 0.1}, {0.01, 0.01, 0.01}),
                                 opinion({0.0, 0.0, -kPi + 0.1}, {0.01, 0.01, 0.01}));
  EXPECT_NEAR(std::abs(both.pose.theta_rad), kPi, 1e-9);
}

TEST(PoseFusion, DistanceIsCountedInBothCovariances) {
  EXPECT_NEAR(squared_distance(opinion({0.0, 0.0, 0.0}, {0.01, 0.01, 0.01}),
                               opinion({0.2, 0.0, 0.0}, {0.01, 0.01, 0.01})),
              2.0, 1e-9);
}

}  // namespace
}  // namespace beaconless
