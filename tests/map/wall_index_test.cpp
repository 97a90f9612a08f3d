// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_index.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

FloorPlan random_plan(Rng& rng, int walls) {
  FloorPlan plan;
  for (int i = 0; i < walls; ++i) {
    const Eigen::Vector2d a(rng.uniform(-10, 10), rng.uniform(-5, 5));
    plan.walls.push_back({a, a + Eigen::Vector2d(rng.normal(2.0), rng.normal(2.0))});
  }
  return plan;
}

TEST(WallIndex, AgreesWithComparingEveryWall) {
  Rng rng(1);
  for (const int walls : {1, 7, 60}) {
    const FloorPlan plan = random_plan(rng, walls);
    const WallIndex index(plan, 1.5, 0.2);
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector2d point(rng.uniform(-14, 14), rng.uniform(-8, 8));
      double slow = std::numeric_limits<double>::infinity();
      for (const Segment2& wall : plan.segments()) slow = std::min(slow, wall.distance_m(point));
      const auto found = index.nearest(point);
      ASSERT_EQ(found.has_value(), slow <= 1.5) << slow;
      if (!found) continue;
      ASSERT_NEAR(found->distance_m, slow, 1e-12);
      ASSERT_NEAR((found->point - point).norm(), slow, 1e-12);
      ASSERT_NEAR(found->normal.norm(), 1.0, 1e-12);
    }
  }
}

TEST(WallIndex, TheSameWallAThousandTimesIsOneWall) {
  FloorPlan plan;
  for (int i = 0; i < 1000; ++i) plan.walls.push_back({{0, 0}, {100, 50}, {0, 0}});
  const WallIndex index(plan);
  EXPECT_EQ(index.wall_count(), 1U);
  EXPECT_TRUE(index.nearest({50.0, 25.2}));
}

TEST(WallIndex, AnswersNothingWithoutWallsAndForNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(WallIndex(FloorPlan{}).nearest({0, 0}));
  const WallIndex index(FloorPlan{{{{0, 0}, {1, 0}}}});
  EXPECT_FALSE(index.nearest({nan, 0}));
  EXPECT_FALSE(index.nearest({0, std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(index.nearest({0.5, 0.5}));
}

}  // namespace
}  // namespace beaconless
