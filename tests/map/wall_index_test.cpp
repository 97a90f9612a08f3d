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

/// What the cells of a tile leave out is left out everywhere in them: no wall is nearer than the nearest
/// found.
TEST(WallIndex, AgreesWithComparingEveryWallWhateverTheCells) {
  Rng rng(2);
  const FloorPlan plan = random_plan(rng, 40);
  const std::vector<Segment2> walls = plan.segments();
  for (const double cell_m : {0.05, 0.1, 0.37, 2.0, 40.0}) {
    const WallIndex index(plan, 0.6, cell_m);
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector2d point(rng.uniform(-14, 14), rng.uniform(-8, 8));
      double slow = std::numeric_limits<double>::infinity();
      for (const Segment2& wall : walls) slow = std::min(slow, wall.distance_m(point));
      const auto found = index.nearest(point);
      ASSERT_EQ(found.has_value(), slow <= 0.6) << slow;
      if (!found) continue;
      ASSERT_NEAR(found->distance_m, slow, 1e-12);
    }
  }
}

/// Rooms of 4 m x 3 m on a lattice of `apart_m`.
FloorPlan rooms(int columns, int rows, double apart_m) {
  FloorPlan plan;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Eigen::Vector2d at(apart_m * x, apart_m * y);
      plan.walls.push_back(
          {at, at + Eigen::Vector2d(4, 0), at + Eigen::Vector2d(4, 3), at + Eigen::Vector2d(0, 3), at});
    }
  return plan;
}

TEST(WallIndex, MemoryGoesWithTheWallsAndNotWithTheSpaceBetweenThem) {
  const auto bytes_a_wall = [](const FloorPlan& plan) {
    const WallIndex index(plan);
    return static_cast<double>(index.memory_bytes()) / static_cast<double>(index.wall_count());
  };
  const double of_few = bytes_a_wall(rooms(2, 2, 8.0));
  EXPECT_LT(bytes_a_wall(rooms(20, 20, 8.0)), 1.3 * of_few);
  EXPECT_LT(bytes_a_wall(rooms(20, 20, 32.0)), 2.0 * of_few);
}

TEST(WallIndex, FindsWallsThatAreMilesApart) {
  const WallIndex index(FloorPlan{{{{0, 0}, {1, 0}}, {{90'000, 70'000}, {90'001, 70'000}}}});
  EXPECT_TRUE(index.nearest({0.5, 0.9}));
  EXPECT_TRUE(index.nearest({90'000.5, 69'999.1}));
  EXPECT_FALSE(index.nearest({45'000, 35'000}));
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
