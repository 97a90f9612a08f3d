// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/feature_tracker.hpp"

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

PointFeature feature(double x_m, double y_m) {
  return {{x_m, y_m}, 1e-4 * Eigen::Matrix2d::Identity(), 0.5, radians(90.0)};
}

const Eigen::Matrix3d kSure = Eigen::Matrix3d::Zero();

TEST(FeatureTracker, RecallsWhatVanishedWhereItShouldBeNow) {
  FeatureTracker tracker;
  const Pose2 before{1.0, 2.0, 0.3};
  const PointFeature corner = feature(2.0, 1.0);
  tracker.remember({&corner, 1}, before);
  const Pose2 now = before * Pose2{0.1, 0.02, 0.2};
  std::vector<PointFeature> seen;
  tracker.recall(now, kSure, seen);
  ASSERT_EQ(seen.size(), 1U);
  const Eigen::Vector2d expected = now.inverse() * (before * corner.point);
  EXPECT_TRUE(seen[0].point.isApprox(expected, 1e-12)) << "not where the moving sensor saw it before";
  EXPECT_NEAR(seen[0].orientation_rad, corner.orientation_rad - 0.2, 1e-12);
  EXPECT_EQ(seen[0].opening_rad, corner.opening_rad);
}

TEST(FeatureTracker, WhatIsSeenNeedsNoMemory) {
  FeatureTracker tracker;
  const PointFeature corner = feature(2.0, 1.0);
  tracker.remember({&corner, 1}, {});
  std::vector<PointFeature> seen = {feature(2.01, 1.0)};
  tracker.recall({}, kSure, seen);
  EXPECT_EQ(seen.size(), 1U);
  EXPECT_EQ(tracker.size(), 0U);
}

TEST(FeatureTracker, ForgetsAfterAFewScans) {
  FeatureTracker tracker({.keep_scans = 3});
  const PointFeature corner = feature(2.0, 1.0);
  tracker.remember({&corner, 1}, {});
  double before = corner.covariance(0, 0);
  for (int scan = 0; scan < 5; ++scan) {
    std::vector<PointFeature> seen;
    tracker.recall({}, kSure, seen);
    ASSERT_EQ(seen.size(), scan < 3 ? 1U : 0U) << scan;
    if (seen.empty()) continue;
    EXPECT_GT(seen[0].covariance(0, 0), before) << "less sure with every scan";
    before = seen[0].covariance(0, 0);
  }
}

TEST(FeatureTracker, AnUncertainRobotRemembersUncertainly) {
  FeatureTracker tracker;
  const PointFeature corner = feature(2.0, 0.0);
  tracker.remember({&corner, 1}, {});
  const Eigen::Matrix3d unsure = Eigen::Vector3d(0.01 * 0.01, 0.02 * 0.02, 0.03 * 0.03).asDiagonal();
  std::vector<PointFeature> seen;
  tracker.recall({}, unsure, seen);
  ASSERT_EQ(seen.size(), 1U);
  const double grown = 1e-4 * (1.0 + FeatureTrackerConfig{}.growth_per_scan);
  EXPECT_NEAR(seen[0].covariance(0, 0), grown + 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(seen[0].covariance(1, 1), grown + 0.02 * 0.02 + 0.06 * 0.06, 1e-12) << "2 m from the laser";
}

/// A wall seen along x is uncertain along x in the map, whichever way the robot has turned since.
TEST(FeatureTracker, TurnsUncertaintyWithTheRobot) {
  FeatureTracker tracker({.growth_per_scan = 0.0});
  PointFeature corner = feature(2.0, 0.0);
  corner.covariance = Eigen::Vector2d(0.04 * 0.04, 0.001 * 0.001).asDiagonal();
  tracker.remember({&corner, 1}, {1.0, 1.0, radians(30.0)});
  const Eigen::Matrix3d unsure_x = Eigen::Vector3d(0.02 * 0.02, 0.0, 0.0).asDiagonal();  // map axes
  std::vector<PointFeature> seen;
  tracker.recall({1.0, 1.0, radians(120.0)}, unsure_x, seen);
  ASSERT_EQ(seen.size(), 1U);
  // The robot turned by 90 degrees: what was along x is along y now.
  const double turned = radians(-120.0);
  const Eigen::Vector2d map_x(std::cos(turned), std::sin(turned));
  Eigen::Matrix2d expected = Eigen::Vector2d(0.001 * 0.001, 0.04 * 0.04).asDiagonal();
  expected += 0.02 * 0.02 * map_x * map_x.transpose();
  EXPECT_TRUE(seen[0].covariance.isApprox(expected, 1e-9)) << seen[0].covariance;
}

/// Many remembered features share one expectation and together tell no more than it did.
TEST(FeatureTracker, ManyTellNoMoreThanTheExpectation) {
  FeatureTracker tracker;
  for (int i = 0; i < 10; ++i) {
    PointFeature corner = feature(2.0, 0.5 * i);
    corner.covariance = 1e-12 * Eigen::Matrix2d::Identity();
    tracker.remember({&corner, 1}, {});
  }
  const Eigen::Matrix3d unsure = Eigen::Vector3d(0.01 * 0.01, 0.01 * 0.01, 0.0).asDiagonal();
  std::vector<PointFeature> seen;
  tracker.recall({}, unsure, seen);
  double information = 0.0;
  for (const PointFeature& of : seen) information += 1.0 / of.covariance(0, 0);
  EXPECT_LE(information, 1.0 / (0.01 * 0.01) * (1.0 + 1e-6));
}

/// Nearness in standard deviations counts where features are vague.
TEST(FeatureTracker, AVagueFeatureIsTheSameFurtherAway) {
  for (const double sigma_m : {0.001, 0.05}) {
    FeatureTracker tracker;
    PointFeature corner = feature(2.0, 1.0);
    corner.covariance = sigma_m * sigma_m * Eigen::Matrix2d::Identity();
    tracker.remember({&corner, 1}, {});
    PointFeature near = corner;
    near.point.x() += 0.1;
    std::vector<PointFeature> seen = {near};
    tracker.recall({}, kSure, seen);
    EXPECT_EQ(seen.size(), sigma_m > 0.01 ? 1U : 2U);
  }
}

TEST(FeatureTracker, ForgetsEverythingAtANewStart) {
  FeatureTracker tracker;
  const PointFeature corner = feature(2.0, 1.0);
  tracker.remember({&corner, 1}, {});
  tracker.forget();
  std::vector<PointFeature> seen;
  tracker.recall({}, kSure, seen);
  EXPECT_TRUE(seen.empty());
}

}  // namespace
}  // namespace beaconless
