// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/growing_map.hpp"

#include <gtest/gtest.h>

#include "beaconless/map/grid_builder.hpp"

#include "tests/slam/drives.hpp"

namespace beaconless {
namespace {

using test::rounds;
using test::TrueScan;

void add(GrowingMap& map, const TrueScan& at) {
  std::vector<BeamWay> ways;
  beam_ways(at.scan, at.map_from_laser, {}, ways);
  ASSERT_TRUE(map.add(at.map_from_laser.translation(), ways));
}

// Slow twin: a grid of its own for every level, from the same scans; and M of its percent.
TEST(GrowingMap, EveryLevelIsWhatTheScansAloneMakeAtItsResolution) {
  const auto drive = rounds(test::niche_room(), 0.02, 30, 10);
  const GrowingMapConfig config;
  GrowingMap map(config);
  std::vector<GridBuilder> twins;
  for (const double resolution_m : {0.05, 0.1, 0.2})
    twins.push_back(GridBuilder::make({.resolution_m = resolution_m,
                                       .p_occupied = config.p_occupied,
                                       .p_free = config.p_free,
                                       .min_log_odds = config.min_log_odds,
                                       .max_log_odds = config.max_log_odds})
                        .value());
  for (const TrueScan& at : drive) {
    add(map, at);
    for (GridBuilder& twin : twins) ASSERT_TRUE(twin.add(at.scan, at.map_from_laser));
  }
  EXPECT_EQ(map.scan_count(), 30U);
  EXPECT_EQ(map.grid(), twins.front().grid());
  ASSERT_EQ(map.pyramid().levels.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const OccupancyLevel& level = map.pyramid().levels[i];
    const OccupancyGrid grid = twins[i].grid();
    EXPECT_EQ(level.resolution_m(), grid.resolution_m);
    const Cell corner{static_cast<int>(std::lround(grid.map_from_grid.x_m / grid.resolution_m)),
                      static_cast<int>(std::lround(grid.map_from_grid.y_m / grid.resolution_m))};
    int known = 0;
    for (int y = -3; y < grid.height_cells + 3; ++y) {
      for (int x = -3; x < grid.width_cells + 3; ++x) {
        const Cell cell{corner.x + x, corner.y + y};
        const int percent = grid.at({x, y});
        ASSERT_EQ(level.is_known(cell), percent != OccupancyGrid::kUnknown);
        if (percent == OccupancyGrid::kUnknown) continue;
        ++known;
        // Whole percent are half a percent off at most, twice that in M; and half a 254th.
        EXPECT_NEAR(level.value(cell), OccupancyLevel::value_of(percent / 100.0), 0.0121);
      }
    }
    EXPECT_GT(known, 100);
  }
}

// Seen at a flat angle, a thin wall shares its coarse cells with the beams that pass it.
TEST(GrowingMap, CoarseCellsKeepThinWalls) {
  GrowingMap map({});
  const RayCaster walls(
      FloorPlan{{{{1.0, -3.0}, {1.0, 3.0}}, {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}, {-8, -8}}}}.segments());
  Rng rng(1);
  for (int i = 0; i < 10; ++i) {
    const Pose2 pose{0.9 - 0.3 * (i % 3), -2.0 + 0.4 * i, 0.0};
    add(map, {test::scan_at(walls, pose, 0.005, rng, {}), pose});
  }
  for (const OccupancyLevel& level : map.pyramid().levels)
    for (double y = -1.5; y < 1.5; y += 0.1)
      EXPECT_GT(level.sample({1.0, y}).value, 0.4) << level.resolution_m();
}

TEST(GrowingMap, HasLimitsOnBothSides) {
  const GrowingMapConfig config{.min_log_odds = -2.0, .max_log_odds = 3.0};
  GrowingMap map(config);
  const std::vector<BeamWay> near{{{1.025, 0.025}, true}};
  const std::vector<BeamWay> far{{{2.025, 0.025}, true}};
  const auto at = [&](double x_m) {
    const OccupancyGrid grid = map.grid();
    return static_cast<int>(grid.at(grid.cell_at({x_m, 0.025})));
  };
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(map.add({0.025, 0.025}, far));
  EXPECT_EQ(at(1.025), 12);  // 1 / (1 + e^2)
  EXPECT_EQ(at(2.025), 95);  // 1 / (1 + e^-3)
  // However long it was free, a cell learns of an obstacle with its second hit: 2.2 each against 2.
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(map.add({0.025, 0.025}, near));
  EXPECT_GE(at(1.025), 65);
}

TEST(GrowingMap, RefusesMoreCellsThanItMayHaveAndStaysAsItWas) {
  GrowingMap map({.max_cells = 10'000});
  const std::vector<BeamWay> near{{{1.0, 1.0}, true}};
  const std::vector<BeamWay> far{{{100.0, 100.0}, true}};
  ASSERT_TRUE(map.add({0.0, 0.0}, near));
  const OccupancyGrid before = map.grid();
  const auto refused = map.add({0.0, 0.0}, far);
  ASSERT_FALSE(refused);
  EXPECT_FALSE(refused.error().remedy.empty());
  EXPECT_EQ(map.grid(), before);
  EXPECT_EQ(map.scan_count(), 1U);
  EXPECT_TRUE(map.add({0.0, 0.0}, {}).ok());
  EXPECT_EQ(map.scan_count(), 1U);
}

}  // namespace
}  // namespace beaconless
