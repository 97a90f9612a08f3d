// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/cell_index.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/nearest_cells.hpp"

namespace beaconless {
namespace {

TEST(NearestSeeds, AgreeWithComparingEverySeed) {
  Rng rng(2);
  for (const int count : {0, 1, 5, 80}) {
    const int width = 37;
    const int height = 23;
    std::vector<std::int32_t> seeds;
    for (int i = 0; i < count; ++i)
      seeds.push_back(static_cast<std::int32_t>(rng.uniform() * width * height));
    const double reach = 9.5;
    const auto nearest = nearest_seeds(width, height, seeds, reach);
    for (int cell = 0; cell < width * height; ++cell) {
      const auto square = [&](std::int32_t seed) {
        const int dx = seed % width - cell % width;
        const int dy = seed / width - cell / width;
        return dx * dx + dy * dy;
      };
      int slow = std::numeric_limits<int>::max();
      for (const auto seed : seeds) slow = std::min(slow, square(seed));
      const std::int32_t found = nearest[static_cast<std::size_t>(cell)];
      ASSERT_EQ(found >= 0, slow <= reach * reach);
      if (found < 0) continue;
      ASSERT_EQ(square(seeds[static_cast<std::size_t>(found)]), slow);
    }
  }
}

OccupancyGrid walled_grid(double heading_rad) {
  OccupancyGrid grid{
      .resolution_m = 0.05, .map_from_grid = {3.0, -2.0, heading_rad}, .width_cells = 80, .height_cells = 40};
  grid.occupancy_percent.assign(80 * 40, OccupancyGrid::kFree);
  for (int x = 5; x < 75; ++x) grid.occupancy_percent[grid.index({x, 20})] = OccupancyGrid::kOccupied;
  return grid;
}

TEST(CellIndex, ARowOfCellsIsAStraightWallWhateverTheHeadingOfTheGrid) {
  for (const double heading : {0.0, 0.7, -2.5}) {
    const OccupancyGrid grid = walled_grid(heading);
    const CellIndex index(grid, 1.0);
    Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector2d in_grid(rng.uniform(0.6, 3.4), rng.uniform(0.3, 1.7));
      const auto found = index.nearest(grid.map_from_grid * in_grid);
      ASSERT_TRUE(found);
      ASSERT_NEAR(found->distance_m, std::abs(in_grid.y() - 20.5 * 0.05), 1e-6);
      ASSERT_NEAR(std::abs(found->normal.dot(grid.map_from_grid.rotation() * Eigen::Vector2d::UnitY())), 1.0,
                  1e-6);
    }
  }
}

TEST(CellIndex, OfAFilledBlockOnlyTheFaceCounts) {
  OccupancyGrid grid = walled_grid(0.0);
  for (int y = 20; y < 40; ++y)
    for (int x = 0; x < 80; ++x) grid.occupancy_percent[grid.index({x, y})] = OccupancyGrid::kOccupied;
  const CellIndex index(grid, 1.0);
  const auto found = index.nearest(grid.map_from_grid * Eigen::Vector2d(2.0, 0.8));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 20.5 * 0.05 - 0.8, 1e-6);
}

TEST(CellIndex, AWallAtTheEdgeOfTheGridIsFoundFromOutside) {
  OccupancyGrid grid = walled_grid(0.4);
  std::fill(grid.occupancy_percent.begin(), grid.occupancy_percent.end(), OccupancyGrid::kFree);
  for (int x = 0; x < 80; ++x) grid.occupancy_percent[grid.index({x, 39})] = OccupancyGrid::kOccupied;
  const auto found = CellIndex(grid, 0.5).nearest(grid.map_from_grid * Eigen::Vector2d(2.0, 40 * 0.05 + 0.2));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 0.225, 1e-6);
}

TEST(CellIndex, AnswersNothingOutsideAndForNonsense) {
  const CellIndex index(walled_grid(0.0), 0.3);
  EXPECT_FALSE(index.nearest({-100.0, 0.0}));
  EXPECT_FALSE(index.nearest({std::numeric_limits<double>::quiet_NaN(), 0.0}));
  EXPECT_FALSE(index.nearest({4.0, -1.9})) << "further than the reach";
  EXPECT_FALSE(CellIndex(OccupancyGrid{}).nearest({0, 0}));
}

}  // namespace
}  // namespace beaconless
