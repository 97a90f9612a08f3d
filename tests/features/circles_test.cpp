// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/circles.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/features/made_scans.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// A column at the origin's bearings, before a wall 6 m away.
Scan column_scan(const Circle2& circle, double sigma_m, Rng& rng) {
  return test::scan_of({}, [&](int, double bearing) {
    const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing));
    const double along = u.dot(circle.centre);
    const double inside = circle.radius_m * circle.radius_m - circle.centre.squaredNorm() + along * along;
    const double wall = 6.0 / std::max(0.05, u.x());
    return (along > 0.0 && inside > 0.0 ? along - std::sqrt(inside) : wall) + rng.normal(sigma_m);
  });
}

TEST(FindCircles, FindsColumnsAsSureAsTheySay) {
  Rng rng(1);
  int found = 0;
  double nees = 0.0;
  const int runs = 400;
  for (int run = 0; run < runs; ++run) {
    const double angle = rng.uniform(-0.5, 0.5);
    const double range = rng.uniform(1.0, 4.0);
    const Circle2 circle{range * Eigen::Vector2d(std::cos(angle), std::sin(angle)), rng.uniform(0.2, 0.4)};
    const auto circles = find_circles(column_scan(circle, 0.005, rng), {.sigma_m = 0.005});
    ASSERT_LE(circles.size(), 1U);
    if (circles.empty()) continue;
    ++found;
    const CircleFit& fit = circles[0].fit;
    EXPECT_LT((fit.circle.centre - circle.centre).norm(), 0.03);
    EXPECT_NEAR(fit.circle.radius_m, circle.radius_m, 0.03);
    EXPECT_GT(circles[0].arc_rad, 1.5);
    const Eigen::Vector3d error(fit.circle.centre.x() - circle.centre.x(),
                                fit.circle.centre.y() - circle.centre.y(),
                                fit.circle.radius_m - circle.radius_m);
    nees += error.dot(fit.covariance.inverse() * error);
  }
  EXPECT_GE(found, runs * 95 / 100);
  EXPECT_NEAR(nees / found, 3.0, 0.5);
}

TEST(FindCircles, WallsAndCornersAreNone) {
  Rng rng(2);
  const RayCaster room(test::niche_room().segments());
  for (int run = 0; run < 300; ++run) {
    const Pose2 pose{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.0), rng.uniform(-kPi, kPi)};
    EXPECT_TRUE(find_circles(test::seen(room, pose, 0.01, rng)).empty());
  }
}

TEST(FindCircles, OverTheEndOfAFullCircle) {
  Rng rng(3);
  FloorPlan plan = test::rectangle(8, 8);
  FloorPlan::Polyline column;
  for (int i = 0; i <= 180; ++i)
    column.emplace_back(2.0 + 0.3 * std::cos(2 * kPi * i / 180), 4.0 + 0.3 * std::sin(2 * kPi * i / 180));
  plan.walls.push_back(column);
  const RayCaster walls(plan.segments());
  const auto circles =
      find_circles(test::seen(walls, {4, 4, 0}, 0.005, rng, test::kFullCircle), {.sigma_m = 0.005});
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_LT((circles[0].fit.circle.centre - Eigen::Vector2d(-2, 0)).norm(), 0.02);
  EXPECT_GT(circles[0].beams.first + circles[0].beams.count, 1440U);
}

TEST(FindCircles, NothingBreaksThemAndNothingIsAllocated) {
  Rng rng(4);
  for (const int beams : {1, 2, 1081})
    for (int run = 0; run < 20; ++run)
      for (const ScanCircle& circle :
           find_circles(test::scan_of({.beams = beams}, [&](int, double) { return rng.uniform(0.0, 3.0); })))
        EXPECT_TRUE(circle.fit.covariance.allFinite());
  const Scan scan = column_scan({{2, 0.1}, 0.3}, 0.005, rng);
  CirclesScratch scratch;
  std::vector<ScanCircle> circles;
  find_circles(scan, {.sigma_m = 0.005}, scratch, circles);
  ASSERT_EQ(circles.size(), 1U);
  const std::size_t before = test::allocations();
  find_circles(scan, {.sigma_m = 0.005}, scratch, circles);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
