// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/rasterize.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// Whether a wall enters a cell's square, found by clipping it to the four sides (Liang and Barsky). `slack`
/// makes the square larger, or smaller.
bool enters(const Segment2& wall, const OccupancyGrid& grid, Cell cell, double slack) {
  const Pose2 grid_from_map = grid.map_from_grid.inverse();
  const Eigen::Vector2d a = grid_from_map * wall.a / grid.resolution_m;
  const Eigen::Vector2d way = grid_from_map * wall.b / grid.resolution_m - a;
  double from = 0.0;
  double to = 1.0;
  for (const int axis : {0, 1}) {
    const double low = (axis == 0 ? cell.x : cell.y) - slack;
    const double high = (axis == 0 ? cell.x : cell.y) + 1.0 + slack;
    if (std::abs(way[axis]) < 1e-12) {
      if (a[axis] < low || a[axis] > high) return false;
      continue;
    }
    const double at_low = (low - a[axis]) / way[axis];
    const double at_high = (high - a[axis]) / way[axis];
    from = std::max(from, std::min(at_low, at_high));
    to = std::min(to, std::max(at_low, at_high));
  }
  return from <= to;
}

TEST(Rasterize, ACellIsOccupiedWhereAWallEntersItAndFreeElsewhere) {
  Rng rng(1);
  for (int run = 0; run < 20; ++run) {
    FloorPlan plan;
    for (int k = 0; k < 4; ++k)
      plan.walls.push_back({{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)},
                            {rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)},
                            {rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)}});
    const OccupancyGrid grid = rasterize(plan, {.resolution_m = 0.1,
                                                .heading_rad = rng.uniform(-3.0, 3.0),
                                                .phase_x_cells = rng.uniform(),
                                                .phase_y_cells = rng.uniform()})
                                   .value();
    for (int y = 0; y < grid.height_cells; ++y)
      for (int x = 0; x < grid.width_cells; ++x) {
        const auto met = [&](double slack) {
          for (const Segment2& wall : plan.segments())
            if (enters(wall, grid, {x, y}, slack)) return true;
          return false;
        };
        if (grid.is_occupied({x, y}))
          ASSERT_TRUE(met(1e-9));
        else
          ASSERT_FALSE(met(-1e-9));
      }
  }
}

TEST(Rasterize, TheMapsOriginLiesWhereInItsCellTheConfigSays) {
  const FloorPlan plan{{{{-1.03, 2.0}, {4.4, 3.0}}}};
  for (const double heading_rad : {0.0, 0.4, -2.0})
    for (const double phase : {0.0, 0.25, 0.5}) {
      const OccupancyGrid grid = rasterize(plan, {.resolution_m = 0.05,
                                                  .heading_rad = heading_rad,
                                                  .phase_x_cells = phase,
                                                  .phase_y_cells = 0.5})
                                     .value();
      const Eigen::Vector2d origin = grid.map_from_grid.inverse() * Eigen::Vector2d(0.0, 0.0) / 0.05;
      EXPECT_NEAR(std::remainder(origin.x() - phase, 1.0), 0.0, 1e-9);
      EXPECT_NEAR(std::remainder(origin.y() - 0.5, 1.0), 0.0, 1e-9);
      EXPECT_DOUBLE_EQ(grid.map_from_grid.theta_rad, heading_rad);
    }
}

TEST(Rasterize, ARoomOfWholeCellsIsDrawnThroughTheMiddlesOfItsCells) {
  const OccupancyGrid grid = rasterize(test::rectangle(4.0, 3.0)).value();
  int occupied = 0;
  for (int y = 0; y < grid.height_cells; ++y)
    for (int x = 0; x < grid.width_cells; ++x) {
      if (!grid.is_occupied({x, y})) continue;
      ++occupied;
      const Eigen::Vector2d middle = grid.center({x, y});
      const double off = std::min(std::min(std::abs(middle.x()), std::abs(middle.x() - 4.0)),
                                  std::min(std::abs(middle.y()), std::abs(middle.y() - 3.0)));
      EXPECT_NEAR(off, 0.0, 1e-9);
    }
  EXPECT_EQ(occupied, 2 * 80 + 2 * 60);
}

TEST(Rasterize, ThereIsAMarginOfFreeCells) {
  const OccupancyGrid grid = rasterize(test::rectangle(1.0, 1.0), {.margin_m = 0.3}).value();
  EXPECT_EQ(grid.width_cells, 21 + 2 * 6);
  for (int x = 0; x < grid.width_cells; ++x)
    for (int y = 0; y < 6; ++y) EXPECT_TRUE(grid.is_free({x, y}));
}

TEST(Rasterize, WhatCannotBeDrawnIsToldWithARemedy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const FloorPlan& plan : {FloorPlan{}, FloorPlan{{{{1.0, 1.0}}}}, FloorPlan{{{{0, 0}, {nan, 1}}}},
                                FloorPlan{{{{0, 0}, {1e7, 1}}}}}) {
    const auto grid = rasterize(plan);
    ASSERT_FALSE(grid.ok());
    EXPECT_FALSE(grid.error().what.empty());
    EXPECT_FALSE(grid.error().remedy.empty());
  }
  const auto large = rasterize(FloorPlan{{{{0, 0}, {1e5, 1e5}}}});
  ASSERT_FALSE(large.ok());
  EXPECT_NE(large.error().remedy.find("resolution_m"), std::string::npos);
  EXPECT_FALSE(rasterize(test::rectangle(1, 1), {.resolution_m = -0.05}).ok());
  EXPECT_FALSE(rasterize(test::rectangle(1, 1), {.heading_rad = nan}).ok());
}

}  // namespace
}  // namespace beaconless
