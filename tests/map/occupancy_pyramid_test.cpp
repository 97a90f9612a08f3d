// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/occupancy_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/rasterize.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

Eigen::Vector2d middle_of(const OccupancyLevel& level, Cell cell) {
  return level.map_from_grid() * (level.resolution_m() * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5));
}

template <class Visit>
void each_cell(const OccupancyLevel& level, Visit&& visit) {
  for (int y = level.low().y; y <= level.high().y; ++y)
    for (int x = level.low().x; x <= level.high().x; ++x) visit(Cell{x, y});
}

TEST(WallValue, IsOneForHalfACellAndFallsByOneACell) {
  EXPECT_EQ(wall_value(0.0, 0.05), 1.0);
  EXPECT_NEAR(wall_value(0.025, 0.05), 1.0, 1e-12);
  EXPECT_NEAR(wall_value(0.05, 0.05), 0.5, 1e-12);
  EXPECT_NEAR(wall_value(0.2, 0.1), 0.0, 1e-12);
  EXPECT_EQ(wall_value(9.0, 0.1), 0.0);
}

TEST(OccupancyPyramid, OfAPlanHasTheValueOfTheNearestWallInEveryCell) {
  const FloorPlan plan = test::niche_room();
  const OccupancyPyramid pyramid = build_pyramid(plan).value();
  ASSERT_EQ(pyramid.levels.size(), 3U);
  double resolution_m = 0.05;
  for (const OccupancyLevel& level : pyramid.levels) {
    EXPECT_DOUBLE_EQ(level.resolution_m(), resolution_m);
    resolution_m *= 2.0;
    EXPECT_EQ(level.map_from_grid().theta_rad, pyramid.levels.front().map_from_grid().theta_rad);
    each_cell(level, [&](Cell cell) {
      double distance_m = std::numeric_limits<double>::infinity();
      for (const Segment2& wall : plan.segments())
        distance_m = std::min(distance_m, wall.distance_m(middle_of(level, cell)));
      ASSERT_TRUE(level.is_known(cell));
      ASSERT_NEAR(level.value(cell), wall_value(distance_m, level.resolution_m()), 0.5 / 254.0 + 1e-9);
    });
  }
}

TEST(OccupancyPyramid, EveryWallOfAPlanIsWorthOneSomewhereInEveryRowItPasses) {
  const FloorPlan plan = test::niche_room();
  const OccupancyPyramid pyramid = build_pyramid(plan).value();
  for (const OccupancyLevel& level : pyramid.levels)
    for (const Segment2& wall : plan.segments())
      for (double share = 0.0; share <= 1.0; share += 0.01) {
        const Eigen::Vector2d point = wall.a + share * (wall.b - wall.a);
        double most = 0.0;
        for (double x = -0.5; x <= 0.5; x += 0.25)
          for (double y = -0.5; y <= 0.5; y += 0.25)
            most = std::max(most, level.sample(point + level.resolution_m() * Eigen::Vector2d(x, y)).value);
        ASSERT_GT(most, 0.9);
      }
}

TEST(OccupancyPyramid, OfAGridKeepsItsCellsAndTheirPercent) {
  OccupancyGrid grid;
  grid.resolution_m = 0.1;
  grid.map_from_grid = {1.0, 2.0, 0.5};
  grid.width_cells = 5;
  grid.height_cells = 3;
  grid.occupancy_percent = {0, 10, 49, 50, 51, 65, 80, 90, 100, -1, -1, 0, 0, 100, 75};
  const OccupancyLevel finest = build_pyramid(grid).value().levels.front();
  EXPECT_EQ(finest.map_from_grid(), grid.map_from_grid);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      const int percent = grid.at({x, y});
      EXPECT_EQ(finest.is_known({x, y}), percent >= 0);
      EXPECT_NEAR(finest.value({x, y}), std::max(0.0, percent / 50.0 - 1.0), 0.5 / 254.0 + 1e-9);
    }
}

TEST(OccupancyPyramid, CoarseCellsOfAGridHaveTheValueOfTheNearestOccupiedCell) {
  Rng rng(7);
  OccupancyGrid grid;
  grid.resolution_m = 0.05;
  grid.map_from_grid = {-1.0, 0.3, -0.4};
  grid.width_cells = 37;
  grid.height_cells = 26;
  for (int i = 0; i < 37 * 26; ++i) {
    const double dice = rng.uniform();
    grid.occupancy_percent.push_back(dice < 0.03 ? 100 : dice < 0.7 ? 0 : -1);
  }
  const OccupancyPyramid pyramid = build_pyramid(grid, {.levels = 4}).value();
  ASSERT_EQ(pyramid.levels.size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) {
    const OccupancyLevel& level = pyramid.levels[i];
    const int times = 1 << i;
    EXPECT_DOUBLE_EQ(level.resolution_m(), 0.05 * times);
    each_cell(level, [&](Cell cell) {
      double distance_m = std::numeric_limits<double>::infinity();
      bool is_known = false;
      for (int y = 0; y < grid.height_cells; ++y)
        for (int x = 0; x < grid.width_cells; ++x) {
          is_known = is_known || (grid.at({x, y}) >= 0 && x / times == cell.x && y / times == cell.y &&
                                  cell.x >= 0 && cell.y >= 0);
          if (grid.is_occupied({x, y}))
            distance_m = std::min(distance_m, (grid.center({x, y}) - middle_of(level, cell)).norm());
        }
      ASSERT_NEAR(level.value(cell), wall_value(distance_m, level.resolution_m()), 0.5 / 254.0 + 1e-9);
      ASSERT_TRUE(level.is_known(cell) || !is_known);
    });
  }
}

TEST(OccupancyPyramid, SaysHowFarDrawingMayHaveMovedWalls) {
  const FloorPlan plan = test::rectangle(4.0, 3.0);
  const double drawn_m = build_pyramid(rasterize(plan).value()).value().wall_sigma_m;
  EXPECT_NEAR(drawn_m, 0.05 / std::sqrt(12.0), 1e-12);
  EXPECT_LT(build_pyramid(plan).value().wall_sigma_m, 0.1 * drawn_m);
}

TEST(OccupancyPyramid, WhatMakesNoPyramidIsToldWithARemedy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OccupancyGrid wrong_count;
  wrong_count.width_cells = 3;
  wrong_count.height_cells = 3;
  wrong_count.occupancy_percent = {0, 100};
  OccupancyGrid no_resolution;
  no_resolution.width_cells = no_resolution.height_cells = 1;
  no_resolution.occupancy_percent = {100};
  no_resolution.resolution_m = 0.0;
  OccupancyGrid nowhere = no_resolution;
  nowhere.resolution_m = 0.05;
  nowhere.map_from_grid.x_m = nan;
  for (const OccupancyGrid& grid : {OccupancyGrid{}, wrong_count, no_resolution, nowhere}) {
    const auto pyramid = build_pyramid(grid);
    ASSERT_FALSE(pyramid.ok());
    EXPECT_FALSE(pyramid.error().remedy.empty());
  }
  for (const FloorPlan& plan :
       {FloorPlan{}, FloorPlan{{{{0, 0}, {nan, 1}}}}, FloorPlan{{{{0, 0}, {1e5, 1e5}}}}}) {
    const auto pyramid = build_pyramid(plan);
    ASSERT_FALSE(pyramid.ok());
    EXPECT_FALSE(pyramid.error().remedy.empty());
  }
  EXPECT_FALSE(build_pyramid(test::rectangle(1, 1), {.levels = 0}).ok());
}

TEST(OccupancyPyramid, AGridOfFreeAndUnknownCellsIsEmptyAndNoError) {
  OccupancyGrid grid;
  grid.width_cells = grid.height_cells = 4;
  grid.occupancy_percent = {0, 0, -1, -1, 0, 0, -1, -1, 0, 0, -1, -1, 0, 0, -1, -1};
  const OccupancyPyramid pyramid = build_pyramid(grid).value();
  for (const OccupancyLevel& level : pyramid.levels)
    each_cell(level, [&](Cell cell) { EXPECT_EQ(level.value(cell), 0.0); });
}

}  // namespace
}  // namespace beaconless
