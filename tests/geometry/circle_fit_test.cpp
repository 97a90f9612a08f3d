// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/circle_fit.hpp"

#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points on_arc(const Circle2& circle, double from_rad, double arc_rad, int count, double sigma_m, Rng& rng) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double angle = from_rad + arc_rad * i / (count - 1);
    points.emplace_back(circle.centre + (circle.radius_m + rng.normal(sigma_m)) *
                                            Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

TEST(CircleFit, FindsExactCirclesFromShortArcs) {
  Rng rng(1);
  for (int run = 0; run < 200; ++run) {
    const Circle2 circle{{rng.uniform(-9, 9), rng.uniform(-9, 9)}, rng.uniform(0.05, 2.0)};
    const auto fit = fit_circle(on_arc(circle, rng.uniform(-kPi, kPi), rng.uniform(0.3, 6.0), 20, 0.0, rng));
    ASSERT_TRUE(fit);
    EXPECT_LT((fit->circle.centre - circle.centre).norm(), 1e-8);
    EXPECT_NEAR(fit->circle.radius_m, circle.radius_m, 1e-8);
    EXPECT_LT(fit->rms_m, 1e-9);
  }
}

TEST(CircleFit, NothingForLinesPointsAndTooFew) {
  EXPECT_FALSE(fit_circle(Points{}));
  EXPECT_FALSE(fit_circle(Points{{1, 0}, {0, 1}}));
  EXPECT_FALSE(fit_circle(Points(6, Eigen::Vector2d(1, 2))));
  EXPECT_FALSE(fit_circle(Points{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
}

TEST(CircleFit, IsAMinimumOfTheSquaredDistances) {
  Rng rng(2);
  const auto square = [](const Points& points, const Circle2& circle) {
    double sum = 0.0;
    for (const auto& point : points) sum += std::pow(circle.signed_distance_m(point), 2);
    return sum;
  };
  for (int run = 0; run < 50; ++run) {
    const Points points = on_arc({{3, 1}, 0.4}, rng.uniform(-kPi, kPi), 2.0, 25, 0.02, rng);
    const auto fit = fit_circle(points).value();
    const double least = square(points, fit.circle);
    EXPECT_NEAR(std::sqrt(least / 25.0), fit.rms_m, 1e-12);
    for (const double step : {-1e-4, 1e-4}) {
      EXPECT_GT(square(points, {fit.circle.centre + Eigen::Vector2d(step, 0), fit.circle.radius_m}), least);
      EXPECT_GT(square(points, {fit.circle.centre + Eigen::Vector2d(0, step), fit.circle.radius_m}), least);
      EXPECT_GT(square(points, {fit.circle.centre, fit.circle.radius_m + step}), least);
    }
  }
}

TEST(CircleFit, CovarianceIsThatOfManyDraws) {
  Rng rng(3);
  const Circle2 circle{{2, -1}, 0.5};
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double nees = 0.0;
  const int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const auto fit = fit_circle(on_arc(circle, 0.5, 3.0, 60, 0.003, rng), 0.003).value();
    const Eigen::Vector3d error(fit.circle.centre.x() - 2, fit.circle.centre.y() + 1,
                                fit.circle.radius_m - 0.5);
    sum += error * error.transpose() / draws;
    nees += error.dot(fit.covariance.inverse() * error) / draws;
  }
  // 2.58 sqrt(6/4000) = 0.10 is the 99 % band of the draws alone.
  EXPECT_NEAR(nees, 3.0, 0.2);
}

}  // namespace
}  // namespace beaconless
