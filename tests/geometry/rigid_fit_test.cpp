// SPDX-License-Identifier: Apache-2.0
// GCC 12 believes that Eigen::umeyama reads beyond a vector of two.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wstringop-overread"
#endif
#include "beaconless/geometry/rigid_fit.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points random_points(Rng& rng, std::size_t count) {
  Points points(count);
  for (auto& p : points) p = {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
  return points;
}

Pose2 random_pose(Rng& rng) {
  return {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), rng.uniform(-kPi, kPi)};
}

std::optional<Pose2> fit(const Points& p, const Points& y, RigidFit rigid_fit = RigidFit()) {
  for (std::size_t i = 0; i < p.size(); ++i) rigid_fit.add(p[i], y[i]);
  return rigid_fit.solve();
}

double gap(const Pose2& a, const Pose2& b) {
  return std::max(
      {std::abs(a.x_m - b.x_m), std::abs(a.y_m - b.y_m), std::abs(wrap_angle(a.theta_rad - b.theta_rad))});
}

TEST(RigidFit, RecoversTheMotionThatWasApplied) {
  Rng rng(1);
  for (std::size_t count : {2U, 3U, 10U, 1081U}) {
    const Pose2 y_from_p = random_pose(rng);
    const Points p = random_points(rng, count);
    Points y;
    for (const auto& point : p) y.push_back(y_from_p * point);
    const auto found = fit(p, y);
    ASSERT_TRUE(found);
    EXPECT_LT(gap(*found, y_from_p), 1e-12) << count;  // 1081 roundings of sums below 5e4: 6e-14 relative
  }
}

TEST(RigidFit, EqualsUmeyamaOnNoisyPairs) {
  Rng rng(2);
  for (int round = 0; round < 100; ++round) {
    const Pose2 y_from_p = random_pose(rng);
    Eigen::Matrix2Xd p(2, 20);
    Eigen::Matrix2Xd y(2, 20);
    RigidFit rigid_fit;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d point(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0));
      p.col(i) = point;
      y.col(i) = y_from_p * point + Eigen::Vector2d(rng.normal(0.5), rng.normal(0.5));
      rigid_fit.add(point, y.col(i));
    }
    const Eigen::Matrix3d expected = Eigen::umeyama(p, y, false);
    const auto found = rigid_fit.solve();
    ASSERT_TRUE(found);
    EXPECT_LT((found->rotation() - expected.topLeftCorner<2, 2>()).norm(), 1e-12);
    EXPECT_LT((found->translation() - expected.topRightCorner<2, 1>()).norm(), 1e-11);
  }
}

TEST(RigidFit, IsTheMinimumOfTheWeightedError) {
  Rng rng(3);
  const Points p = random_points(rng, 12);
  const Points y = random_points(rng, 12);
  std::vector<double> weights(12);
  RigidFit rigid_fit;
  for (std::size_t i = 0; i < p.size(); ++i) rigid_fit.add(p[i], y[i], weights[i] = rng.uniform(0.1, 3.0));
  const auto error_of = [&](const Pose2& y_from_p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += weights[i] * (y[i] - y_from_p * p[i]).squaredNorm();
    return sum;
  };
  const Pose2 best = rigid_fit.solve().value();
  for (int i = 0; i < 200; ++i) {
    const Pose2 other{best.x_m + rng.normal(0.1), best.y_m + rng.normal(0.1),
                      best.theta_rad + rng.normal(0.1)};
    EXPECT_GT(error_of(other), error_of(best));
  }
}

TEST(RigidFit, AWeightOfTwoIsThePairTwice) {
  Rng rng(4);
  const Points p = random_points(rng, 5);
  const Points y = random_points(rng, 5);
  RigidFit weighted;
  RigidFit repeated;
  for (std::size_t i = 0; i < p.size(); ++i) {
    weighted.add(p[i], y[i], i == 2 ? 2.0 : 1.0);
    repeated.add(p[i], y[i]);
    if (i == 2) repeated.add(p[i], y[i]);
  }
  EXPECT_LT(gap(*weighted.solve(), *repeated.solve()), 1e-12);
}

TEST(RigidFit, GivesAProperRotationForMirroredData) {
  Rng rng(5);
  for (int round = 0; round < 100; ++round) {
    Points p = random_points(rng, 8);
    Points y;
    for (const auto& point : p) y.emplace_back(-point.x(), point.y());
    const auto found = fit(p, y);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->rotation().determinant(), 1.0, 1e-12);
    EXPECT_TRUE(found->is_finite());
  }
}

TEST(RigidFit, TheOrderOfPairsDoesNotMatter) {
  Rng rng(6);
  Points p = random_points(rng, 50);
  Points y = random_points(rng, 50);
  const auto forward = fit(p, y);
  std::reverse(p.begin(), p.end());
  std::reverse(y.begin(), y.end());
  EXPECT_LT(gap(*forward, *fit(p, y)), 1e-11);
}

TEST(RigidFit, AnOriginNearTheDataKeepsThePrecisionFarAway) {
  Rng rng(7);
  const Eigen::Vector2d far(5e5, -3e6);  // a hall in national coordinates
  const Points p = random_points(rng, 100);
  const Pose2 turn{0.0, 0.0, 0.3};
  Points y;
  for (const auto& point : p) y.push_back(turn * point + far);
  const auto found = fit(p, y, RigidFit(Eigen::Vector2d::Zero(), far));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->theta_rad, 0.3, 1e-9);  // coordinates of 3e6 m are good to 5e-10 m
  EXPECT_LT((found->translation() - far).norm(), 1e-8);
}

TEST(RigidFit, SaysNothingWhereTheHeadingIsFree) {
  EXPECT_FALSE(RigidFit().solve()) << "no pairs";

  RigidFit one;
  one.add({1.3, 2.7}, {3.1, 4.9});
  EXPECT_FALSE(one.solve()) << "one pair";

  // The same point again and again: sums of inexact squares do not cancel to zero, only to rounding.
  Rng rng(8);
  for (int round = 0; round < 100; ++round) {
    const Eigen::Vector2d p(rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0));
    const Points y = random_points(rng, 300);
    EXPECT_FALSE(fit(Points(300, p), Points(300, y[0]))) << "one point, repeated";
    EXPECT_FALSE(fit(Points(300, p), y)) << "all scan points the same";
    EXPECT_FALSE(fit(y, Points(300, p))) << "all partners the same";
  }

  RigidFit weightless;
  weightless.add({0.0, 0.0}, {1.0, 0.0}, 0.0);
  weightless.add({1.0, 0.0}, {2.0, 0.0}, 0.0);
  EXPECT_FALSE(weightless.solve()) << "no weight";

  RigidFit poisoned;
  poisoned.add({0.0, 0.0}, {1.0, 0.0});
  poisoned.add({1.0, std::nan("")}, {2.0, 0.0});
  EXPECT_FALSE(poisoned.solve()) << "not a number";
}

}  // namespace
}  // namespace beaconless
