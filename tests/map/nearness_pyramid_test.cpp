// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/nearness_pyramid.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/map/rasterize.hpp"

namespace beaconless {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kTruncate_m = 0.3;

FloorPlan three_walls() {
  FloorPlan plan;
  plan.walls = {{{-1.0, 0.5}, {0.8, 0.9}, {0.8, 2.0}}, {{0.0, 1.5}, {0.1, 1.5}}};
  return plan;
}

/// The byte of one block, as the search reads it; 0 where there is none.
int block_at(const NearnessPyramid& map, int level, Cell cell) {
  const std::uint8_t* tile = map.tile(level, cell);
  return tile == nullptr ? 0 : *tile;
}

/// What the formula gives for the middle of a cell.
int expected_at(const NearnessPyramid& map, const WallIndex& walls, Cell cell) {
  const auto surface = walls.nearest(map.low() + map.cell_m() * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5));
  if (!surface) return 0;
  const double share = surface->distance_m / kTruncate_m;
  return static_cast<int>(std::lround(255.0 * std::max(0.0, 1.0 - share * share)));
}

TEST(NearnessPyramid, CellsTellHowNearTheNearestWallIsEvenOutside) {
  const WallIndex walls(three_walls());
  const NearnessPyramid map{SurfaceMap(walls), kCell_m, kTruncate_m};
  int on_walls = 0;
  for (int y = -30; y < map.height_cells() + 30; ++y)
    for (int x = -30; x < map.width_cells() + 30; ++x) {
      ASSERT_EQ(block_at(map, 0, {x, y}), expected_at(map, walls, {x, y})) << x << ", " << y;
      on_walls += block_at(map, 0, {x, y}) > 250 ? 1 : 0;
    }
  EXPECT_GT(on_walls, 50);
}

TEST(NearnessPyramid, EveryBlockHoldsTheGreatestOfItsCellsWhereverItsTileBegins) {
  const NearnessPyramid map{SurfaceMap(WallIndex(three_walls())), kCell_m, kTruncate_m};
  Rng rng(3);
  for (int level = 0; level < NearnessPyramid::kLevels; ++level) {
    const int size = NearnessPyramid::block_cells(level);
    int near = 0;
    for (int i = 0; i < 300; ++i) {
      const Cell first{static_cast<int>(rng.uniform(-18 * size, map.width_cells() + 2 * size)),
                       static_cast<int>(rng.uniform(-6 * size, map.height_cells() + 2 * size))};
      const std::uint8_t* tile = map.tile(level, first);
      for (int row = 0; row < NearnessPyramid::kTileRows; ++row)
        for (int column = 0; column < NearnessPyramid::kTileColumns; ++column) {
          int greatest = 0;
          for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
              greatest = std::max(greatest,
                                  block_at(map, 0, {first.x + column * size + x, first.y + row * size + y}));
          const auto offset =
              static_cast<std::size_t>(row) * map.pitch(level) + static_cast<std::size_t>(column);
          near += greatest > 0 ? 1 : 0;
          ASSERT_EQ(tile == nullptr ? 0 : tile[offset], greatest)
              << "level " << level << " at " << first.x << ", " << first.y << ": " << column << ", " << row;
        }
    }
    EXPECT_GT(near, 500) << level;
  }
}

TEST(NearnessPyramid, ThatOfAGridIsThatOfItsPlanButForTheRaster) {
  const FloorPlan plan = three_walls();
  const NearnessPyramid by_plan{SurfaceMap(WallIndex(plan)), kCell_m, kTruncate_m};
  const auto grid = rasterize(plan);
  ASSERT_TRUE(grid) << grid.error();
  const NearnessPyramid by_grid{SurfaceMap(CellIndex(*grid)), kCell_m, kTruncate_m};
  const Eigen::Vector2d shift = (by_plan.low() - by_grid.low()) / kCell_m;
  int worst = 0;
  for (int y = 0; y < by_plan.height_cells(); ++y)
    for (int x = 0; x < by_plan.width_cells(); ++x) {
      const Cell same{static_cast<int>(std::lround(x + shift.x())),
                      static_cast<int>(std::lround(y + shift.y()))};
      worst = std::max(worst, std::abs(block_at(by_plan, 0, {x, y}) - block_at(by_grid, 0, same)));
    }
  EXPECT_LT(worst, 130);  // that of 7.5 cm, where nearness falls fastest
}

TEST(NearnessPyramid, HugePlansGetLargerCellsInsteadOfMoreMemory) {
  FloorPlan plan;
  plan.walls = {{{0.0, 0.0}, {1000.0, 0.0}}, {{0.0, 900.0}, {10.0, 900.0}}};
  const NearnessPyramid map{SurfaceMap(WallIndex(plan)), kCell_m, kTruncate_m};
  EXPECT_GT(map.cell_m(), 0.4);
  EXPECT_LT(map.bytes(), 30e6);
  // A wall that lies between the middles of cells is seen even so.
  for (int x = 1; x < 1000; x += 111) {
    const Cell cell = cell_of((Eigen::Vector2d(x, 0.0) - map.low()) / map.cell_m());
    EXPECT_GT(block_at(map, 0, cell), 200);
  }
}

}  // namespace
}  // namespace beaconless
