// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/feature_icp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

FeatureMap map_of(std::vector<PointFeature> features) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(features.size());
  for (const PointFeature& feature : features) points.push_back(feature.point);
  FeatureMap map{.features = std::move(features)};
  map.evidence.resize(points.size());
  map.places = PointBuckets(points, 0.5);
  return map;
}

PointFeature corner(double x_m, double y_m, double orientation_deg, double opening_deg = 90.0,
                    double sigma_m = 0.005) {
  return {{x_m, y_m},
          sigma_m * sigma_m * Eigen::Matrix2d::Identity(),
          radians(orientation_deg),
          radians(opening_deg)};
}

/// The corners of a 4 x 3 m room, and those of a pillar in it.
std::vector<PointFeature> room() {
  return {corner(0, 0, 45),     corner(4, 0, 135),   corner(4, 3, -135), corner(0, 3, -45),
          corner(1.5, 1.5, 45), corner(2, 1.5, 135), corner(2, 2, -135), corner(1.5, 2, -45)};
}

/// Those features as a laser sees them from a pose.
std::vector<PointFeature> seen_from(const std::vector<PointFeature>& features, const Pose2& map_from_laser) {
  const Pose2 laser_from_map = map_from_laser.inverse();
  const Eigen::Matrix2d turn = laser_from_map.rotation();
  std::vector<PointFeature> seen = features;
  for (PointFeature& feature : seen) {
    feature.point = laser_from_map * feature.point;
    feature.covariance = turn * feature.covariance * turn.transpose();
    feature.orientation_rad = wrap_angle(feature.orientation_rad + laser_from_map.theta_rad);
  }
  return seen;
}

MatchResult match(const std::vector<PointFeature>& seen, const FeatureMap& map, const Pose2& guess,
                  const FeatureIcpConfig& config = {}) {
  FeatureIcpScratch scratch;
  return match_feature_icp(seen, map, guess, config, scratch);
}

void expect_pose(const MatchResult& result, const Pose2& truth, double tolerance_m, double tolerance_rad) {
  ASSERT_TRUE(result.usable());
  EXPECT_LT(distance_m(result.map_from_laser, truth), tolerance_m);
  EXPECT_LT(heading_difference_rad(result.map_from_laser, truth), tolerance_rad);
}

const Pose2 kTruth{1.0, 0.8, 0.6};

TEST(FeatureIcp, OneStepIsExactWherePartnersAreRight) {
  const auto seen = seen_from(room(), kTruth);
  const Pose2 guess{1.08, 0.75, 0.66};
  expect_pose(match(seen, map_of(room()), guess, {.max_iterations = 1}), kTruth, 1e-12, 1e-12);
  const MatchResult whole = match(seen, map_of(room()), guess);
  EXPECT_EQ(whole.status, MatchStatus::converged);
  EXPECT_EQ(whole.pair_count, 8);
  EXPECT_EQ(whole.rank, 3);
  expect_pose(whole, kTruth, 1e-9, 1e-9);
}

TEST(FeatureIcp, WhatIsRightAlreadyStays) {
  const MatchResult result = match(seen_from(room(), kTruth), map_of(room()), kTruth);
  expect_pose(result, kTruth, 1e-12, 1e-12);
}

TEST(FeatureIcp, DoesNotMindTheOrderOfFeatures) {
  Rng rng(3);
  auto seen = seen_from(room(), kTruth);
  for (PointFeature& feature : seen) feature.point += Eigen::Vector2d(rng.normal(0.005), rng.normal(0.005));
  const MatchResult forwards = match(seen, map_of(room()), kTruth);
  std::reverse(seen.begin(), seen.end());
  auto mapped = room();
  std::rotate(mapped.begin(), mapped.begin() + 3, mapped.end());
  expect_pose(match(seen, map_of(mapped), kTruth), forwards.map_from_laser, 1e-9, 1e-9);
}

TEST(FeatureIcp, TurnsWithTheMap) {
  Rng rng(4);
  auto seen = seen_from(room(), kTruth);
  for (PointFeature& feature : seen) feature.point += Eigen::Vector2d(rng.normal(0.005), rng.normal(0.005));
  const MatchResult here = match(seen, map_of(room()), kTruth);
  const Pose2 there_from_here{-20.0, 7.0, 2.2};
  const auto moved = seen_from(room(), there_from_here.inverse());
  const MatchResult there = match(seen, map_of(moved), there_from_here * kTruth);
  expect_pose(there, there_from_here * here.map_from_laser, 1e-9, 1e-9);
  const Eigen::Matrix3d turned =
      moved_covariance(here.covariance, here.map_from_laser, {});  // map axes turn, the laser stays
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = there_from_here.rotation();
  EXPECT_TRUE(there.covariance.isApprox(rotation * turned * rotation.transpose(), 1e-6));
}

/// Known-good pairs only, slow and plain: minimise Σ rᵀ S⁻¹ r by small steps.
TEST(FeatureIcp, FindsTheWeightedOptimum) {
  Rng rng(5);
  auto mapped = room();
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    const double along = 0.002 + 0.01 * rng.uniform();
    const double across = 0.002 + 0.002 * rng.uniform();
    const Eigen::Matrix2d turn = Pose2{0, 0, 0.7 * static_cast<double>(i)}.rotation();
    const Eigen::Matrix2d own = Eigen::Vector2d(along * along, across * across).asDiagonal();
    mapped[i].covariance = turn * own * turn.transpose();
  }
  auto seen = seen_from(mapped, kTruth);
  for (PointFeature& feature : seen) feature.point += Eigen::Vector2d(rng.normal(0.003), rng.normal(0.003));
  const FeatureIcpConfig config{.loss_k_sigma = 100.0, .least_sigma_m = 1e-6};
  const MatchResult result = match(seen, map_of(mapped), kTruth, config);
  ASSERT_EQ(result.pair_count, 8);
  const auto cost = [&](const Pose2& pose) {
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Eigen::Matrix2d turn = pose.rotation();
      const Eigen::Vector2d residual = pose * seen[i].point - mapped[i].point;
      const Eigen::Matrix2d spread = turn * seen[i].covariance * turn.transpose() + mapped[i].covariance;
      sum += residual.dot(spread.inverse() * residual);
    }
    return sum;
  };
  const double least = cost(result.map_from_laser);
  for (const double step : {1e-4, 1e-5}) {
    for (int axis = 0; axis < 6; ++axis) {
      Pose2 other = result.map_from_laser;
      (axis % 3 == 0 ? other.x_m : axis % 3 == 1 ? other.y_m : other.theta_rad) += axis < 3 ? step : -step;
      EXPECT_GT(cost(other), least - 1e-4) << axis;
    }
  }
}

TEST(FeatureIcp, ARoomsCornerIsNeverTakenForAPillars) {
  // The pillar stands so that its corner is the nearest to where the guess puts the room's.
  std::vector<PointFeature> mapped = {corner(0, 0, 45), corner(4, 0, 135), corner(4, 3, -135),
                                      corner(0, 3, -45), corner(0.15, 0.1, -135)};
  const std::vector<PointFeature> four(mapped.begin(), mapped.begin() + 4);
  const Pose2 guess{kTruth.x_m + 0.14, kTruth.y_m + 0.1, kTruth.theta_rad};
  expect_pose(match(seen_from(four, kTruth), map_of(mapped), guess), kTruth, 1e-9, 1e-9);
  // Without that rule the pillar's corner is a partner like any other.
  const FeatureIcpConfig blind{.max_turn_deg = 180.0, .max_iterations = 1};
  EXPECT_GT(distance_m(match(seen_from(four, kTruth), map_of(mapped), guess, blind).map_from_laser, kTruth),
            0.005);
}

TEST(FeatureIcp, PairsAreOneToOne) {
  std::vector<PointFeature> seen = seen_from(room(), kTruth);
  PointFeature ghost = seen[0];
  ghost.point += Eigen::Vector2d(0.03, 0.0);
  seen.insert(seen.begin(), ghost);
  const MatchResult result = match(seen, map_of(room()), kTruth);
  EXPECT_EQ(result.pair_count, 8);
  expect_pose(result, kTruth, 1e-9, 1e-9);
}

TEST(FeatureIcp, AMisplacedFeaturePullsLittle) {
  auto seen = seen_from(room(), kTruth);
  seen[2].point += Eigen::Vector2d(0.12, -0.05);
  for (const LossKind loss :
       {LossKind::huber, LossKind::cauchy, LossKind::tukey, LossKind::welsch, LossKind::geman_mcclure})
    expect_pose(match(seen, map_of(room()), kTruth, {.loss = loss}), kTruth, 1e-3, 1e-3);
}

TEST(FeatureIcp, OneFeatureIsNoPoseAndNoneIsNone) {
  const Pose2 guess{1.02, 0.8, 0.6};
  for (const std::size_t count : {0U, 1U}) {
    auto seen = seen_from(room(), kTruth);
    seen.resize(count);
    const MatchResult result = match(seen, map_of(room()), guess);
    EXPECT_EQ(result.status, MatchStatus::too_few_pairs);
    EXPECT_EQ(result.map_from_laser, guess);
  }
  EXPECT_EQ(match(seen_from(room(), kTruth), map_of({}), guess).status, MatchStatus::too_few_pairs);
}

TEST(FeatureIcp, TwoFeaturesThatNearlyCoincideTellNoHeading) {
  const std::vector<PointFeature> mapped = {corner(3, 1, 0, 90, 0.02), corner(3, 1.001, 90, 90, 0.02)};
  const MatchResult result = match(seen_from(mapped, kTruth), map_of(mapped), kTruth);
  ASSERT_TRUE(result.usable());
  EXPECT_LT(result.rank, 3);
  EXPECT_GT(result.covariance(2, 2), 1.0);
}

TEST(FeatureIcp, NotFiniteInputGivesNoPairs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto seen = seen_from(room(), kTruth);
  EXPECT_FALSE(match(seen, map_of(room()), {nan, 0, 0}).usable());
}

/// The covariance is what many trials scatter by.
TEST(FeatureIcp, TellsItsCovariance) {
  Rng rng(6);
  const FeatureMap map = map_of(room());
  const auto exact = seen_from(room(), kTruth);
  double nees = 0.0;
  constexpr int kTrials = 2000;
  // Maps are exact here, so what the map's features claim is set aside.
  auto mapped = room();
  for (PointFeature& feature : mapped) feature.covariance.setZero();
  const FeatureMap exact_map = map_of(mapped);
  for (int trial = 0; trial < kTrials; ++trial) {
    auto seen = exact;
    for (PointFeature& feature : seen) feature.point += Eigen::Vector2d(rng.normal(0.005), rng.normal(0.005));
    const MatchResult result =
        match(seen, exact_map, kTruth, {.loss_k_sigma = 100.0, .gate_sigma = 100.0, .least_sigma_m = 1e-6});
    const Eigen::Vector3d error(result.map_from_laser.x_m - kTruth.x_m,
                                result.map_from_laser.y_m - kTruth.y_m,
                                result.map_from_laser.theta_rad - kTruth.theta_rad);
    nees += error.dot(result.covariance.inverse() * error) / kTrials;
  }
  // Residuals above what the features claim widen it, those below do not narrow it: a little under 3.
  EXPECT_GT(nees, 2.4);
  EXPECT_LT(nees, 3.0 + 2.58 * std::sqrt(6.0 / kTrials));
}

}  // namespace
}  // namespace beaconless
