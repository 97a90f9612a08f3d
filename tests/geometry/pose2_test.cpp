// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/pose2.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

// Coordinates are below 10 m and a dozen roundings happen on the way: 12 * 10 * 2^-53 is 1.3e-14.
constexpr double kRounding = 1e-13;

/// Headings where formulas like to break, then random ones.
std::vector<double> headings() {
  std::vector<double> list{0.0,    1e-12, -1e-12, 1e-8,       -1e-8,       0.9999e-4,
                           1.1e-4, 1e-2,  -kPi,   kPi - 1e-8, -kPi + 1e-8, std::nextafter(kPi, 0.0),
                           1.0,    -2.0,  3.0,    kPi / 2.0,  -kPi / 2.0,  kPi - 1e-4};
  Rng rng(3);
  for (int i = 0; i < 100; ++i) list.push_back(rng.uniform(-kPi, kPi));
  return list;
}

Pose2 random_pose(Rng& rng, double theta_rad) {
  return {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), theta_rad};
}
Pose2 random_pose(Rng& rng) { return random_pose(rng, rng.uniform(-kPi, kPi)); }

/// Largest difference of two poses, heading along the shorter way.
double gap(const Pose2& a, const Pose2& b) {
  return std::max(
      {std::abs(a.x_m - b.x_m), std::abs(a.y_m - b.y_m), std::abs(wrap_angle(a.theta_rad - b.theta_rad))});
}

bool heading_is_wrapped(const Pose2& pose) { return pose.theta_rad >= -kPi && pose.theta_rad < kPi; }

TEST(Pose2, IsAGroup) {
  Rng rng(4);
  const Pose2 identity;
  for (const double theta : headings()) {
    const Pose2 a = random_pose(rng, theta);
    const Pose2 b = random_pose(rng);
    const Pose2 c = random_pose(rng);
    EXPECT_EQ(gap(a * identity, a), 0.0) << a;
    EXPECT_EQ(gap(identity * a, a), 0.0) << a;
    EXPECT_LT(gap(a * a.inverse(), identity), kRounding) << a;
    EXPECT_LT(gap(a.inverse() * a, identity), kRounding) << a;
    EXPECT_LT(gap((a * b) * c, a * (b * c)), kRounding) << a << b << c;
    EXPECT_LT(gap((a * b).inverse(), b.inverse() * a.inverse()), kRounding) << a << b;
    EXPECT_TRUE(heading_is_wrapped(a * b) && heading_is_wrapped(a.inverse()));
  }
}

TEST(Pose2, ActsOnPointsAsTheMatrixDoes) {
  Rng rng(5);
  for (const double theta : headings()) {
    const Pose2 a = random_pose(rng, theta);
    const Pose2 b = random_pose(rng);
    const Eigen::Vector2d p(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0));
    EXPECT_LT((a * p - (a.rotation() * p + a.translation())).norm(), kRounding);
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), kRounding);
    EXPECT_NEAR((a * p - a * Eigen::Vector2d::Zero()).norm(), p.norm(), kRounding)
        << "a rigid motion keeps lengths";
    EXPECT_NEAR(a.rotation().determinant(), 1.0, kRounding);
  }
}

TEST(Pose2, ExpAndLogUndoEachOther) {
  Rng rng(6);
  for (const double theta : headings()) {
    const Pose2 pose = random_pose(rng, theta);
    EXPECT_LT(gap(Pose2::exp(pose.log()), pose), 1e-12) << pose;
    const Twist2 twist{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), theta};
    EXPECT_LT((Pose2::exp(twist).log().vector() - twist.vector()).cwiseAbs().maxCoeff(), 1e-12) << theta;
    EXPECT_LT(gap(Pose2::exp(-1.0 * twist), Pose2::exp(twist).inverse()), 1e-12) << theta;
  }
}

// The slow twin: the definition, exp(v) = lim (1 + v/n)^n, by repeated squaring of a motion so short that its
// second-order term is exact to rounding. 2^30 steps: the neglected third order is (pi/2^30)^3 * 2^30 <
// 3e-17.
TEST(Pose2, ExpIsTheLimitOfManySmallSteps) {
  for (const double theta : headings()) {
    const long double n = 1L << 30;
    const long double x = 3.0L, y = -2.0L, w = theta;
    long double c = 1.0L - (w / n) * (w / n) / 2.0L, s = w / n;
    long double px = x / n - y * w / (2.0L * n * n), py = y / n + x * w / (2.0L * n * n);
    for (int i = 0; i < 30; ++i) {
      const long double qx = px + c * px - s * py, qy = py + s * px + c * py;
      const long double c2 = c * c - s * s, s2 = 2.0L * s * c;
      px = qx, py = qy, c = c2, s = s2;
    }
    const Pose2 pose = Pose2::exp({3.0, -2.0, theta});
    // Long doubles lose 2^30 * 2^-64 = 6e-11 of the rotation at worst, double precision 1e-15 of the pose.
    EXPECT_NEAR(pose.x_m, static_cast<double>(px), 1e-9) << theta;
    EXPECT_NEAR(pose.y_m, static_cast<double>(py), 1e-9) << theta;
  }
}

TEST(Pose2, ExpHasNoSeamWhereTheSeriesEnds) {
  // Third-order Taylor of the exact V(theta) around 1e-4: good to 1e-4^4 / 120 = 1e-18 on both sides.
  for (const double theta : {0.5e-4, std::nextafter(1e-4, 0.0), 1e-4, 2e-4}) {
    const Pose2 pose = Pose2::exp({1.0, 0.0, theta});
    EXPECT_NEAR(pose.x_m, 1.0 - theta * theta / 6.0, 3e-16) << theta;
    EXPECT_NEAR(pose.y_m, theta / 2.0 - theta * theta * theta / 24.0, 1e-19) << theta;
  }
}

TEST(Pose2, AdjointMovesATwistThroughAPose) {
  Rng rng(7);
  for (const double theta : headings()) {
    const Pose2 pose = random_pose(rng, theta);
    const Twist2 twist{rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)};
    const Eigen::Vector3d moved = pose.adjoint() * twist.vector();
    EXPECT_LT(gap(pose * Pose2::exp(twist), Pose2::exp({moved.x(), moved.y(), moved.z()}) * pose), 1e-12)
        << pose;
    EXPECT_TRUE((pose.adjoint() * pose.inverse().adjoint()).isIdentity(1e-12)) << pose;
  }
}

TEST(Pose2, InterpolationRunsAlongOneTwist) {
  Rng rng(8);
  for (const double theta : headings()) {
    const Pose2 a = random_pose(rng, theta);
    const Pose2 b = a * Pose2::exp({rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-3.0, 3.0)});
    EXPECT_LT(gap(interpolate(a, b, 0.0), a), 1e-12);
    EXPECT_LT(gap(interpolate(a, b, 1.0), b), 1e-12);
    const Pose2 half = interpolate(a, b, 0.5);
    EXPECT_LT(gap(half * (a.inverse() * half), b), 1e-12) << "the second half is the first half again";
    EXPECT_LT(gap(interpolate(a, b, 2.0), b * (a.inverse() * b)), 1e-12) << "and goes on beyond the end";
  }
}

TEST(Pose2, InterpolationTakesTheShorterWayAcrossPi) {
  const Pose2 half = interpolate({0.0, 0.0, 3.0}, {0.0, 0.0, -3.0}, 0.5);
  EXPECT_NEAR(std::abs(half.theta_rad), kPi, 1e-12);
}

TEST(Pose2, HeadingDifferenceIsTheShorterWay) {
  EXPECT_NEAR(heading_difference_rad({0.0, 0.0, 3.0}, {0.0, 0.0, -3.0}), 2.0 * kPi - 6.0, 1e-15);
  EXPECT_DOUBLE_EQ(heading_difference_rad({0.0, 0.0, 0.0}, {0.0, 0.0, -kPi}), kPi);
  EXPECT_DOUBLE_EQ(distance_m({1.0, 1.0, 0.0}, {4.0, 5.0, 2.0}), 5.0);
}

TEST(Pose2, MovedCovarianceIsTheNumericPropagation) {
  Rng rng(9);
  constexpr double kStep =
      1e-5;  // central differences: error step² / 6 * 5 m < 1e-10, rounding 1e-15 / 1e-5 = 1e-10
  for (const double theta : headings()) {
    const Pose2 map_from_a = random_pose(rng, theta);
    const Pose2 a_from_b = random_pose(rng);
    Eigen::Matrix3d root;
    for (int i = 0; i < 9; ++i) root.data()[i] = rng.normal();
    const Eigen::Matrix3d covariance_a = root * root.transpose();

    const auto b_when = [&](Eigen::Vector3d change) {
      return Pose2{map_from_a.x_m + change.x(), map_from_a.y_m + change.y(),
                   map_from_a.theta_rad + change.z()} *
             a_from_b;
    };
    Eigen::Matrix3d jacobian;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d change = kStep * Eigen::Vector3d::Unit(i);
      const Pose2 more = b_when(change);
      const Pose2 less = b_when(-change);
      jacobian.col(i) = Eigen::Vector3d(more.x_m - less.x_m, more.y_m - less.y_m,
                                        wrap_angle(more.theta_rad - less.theta_rad)) /
                        (2.0 * kStep);
    }
    const Eigen::Matrix3d expected = jacobian * covariance_a * jacobian.transpose();
    const Eigen::Matrix3d moved = moved_covariance(covariance_a, map_from_a, a_from_b);
    EXPECT_LT((moved - expected).norm(), 1e-7 * expected.norm()) << map_from_a << a_from_b;
    EXPECT_LT((moved_covariance(moved, map_from_a * a_from_b, a_from_b.inverse()) - covariance_a).norm(),
              1e-11 * moved.norm())
        << "there and back";
  }
}

}  // namespace
}  // namespace beaconless
