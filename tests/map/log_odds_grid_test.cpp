// SPDX-License-Identifier: Apache-2.0
// What GridBuilder's tests do not ask: what is told of each change.
#include "beaconless/map/log_odds_grid.hpp"

#include <map>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

std::vector<BeamWay> random_ways(Rng& rng) {
  std::vector<BeamWay> ways;
  for (int i = 0; i < 60; ++i)
    ways.push_back({{rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0)}, rng.uniform(0.0, 1.0) < 0.8});
  return ways;
}

TEST(LogOddsGrid, TellsEveryChangeOfACellOnceAScan) {
  LogOddsGrid grid(0.1, {}, 1'000'000);
  std::map<std::pair<int, int>, int> known;
  Rng rng(3);
  for (int scan = 0; scan < 40; ++scan) {
    std::map<std::pair<int, int>, int> changed;
    const auto added = grid.add({rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)}, random_ways(rng),
                                [&](Cell cell, int before, int now) {
                                  EXPECT_TRUE(changed.emplace(std::pair(cell.x, cell.y), now).second);
                                  const auto [at, is_new] = known.emplace(std::pair(cell.x, cell.y), 0);
                                  EXPECT_EQ(at->second, before);
                                  at->second = now;
                                });
    ASSERT_TRUE(added);
    EXPECT_GT(changed.size(), 500U);
  }
  // What was told is what the grid knows.
  const OccupancyGrid drawn = grid.grid();
  std::size_t cells = 0;
  for (const std::int8_t percent : drawn.occupancy_percent)
    cells += percent != OccupancyGrid::kUnknown ? 1U : 0U;
  EXPECT_EQ(cells, known.size());
  for (const auto& [cell, log_odds] : known) {
    const Cell at = drawn.cell_at({0.1 * cell.first + 0.05, 0.1 * cell.second + 0.05});
    EXPECT_EQ(drawn.at(at), std::lround(100.0 * LogOddsGrid::probability(log_odds)));
  }
}

TEST(LogOddsGrid, MakesRoomWithoutKnowingMore) {
  LogOddsGrid grid(0.1, {}, 1'000'000);
  ASSERT_TRUE(grid.cover({0.0, 0.0}, std::vector<BeamWay>{{{5.0, 5.0}, true}}));
  EXPECT_EQ(grid.grid().occupancy_percent.size(), 0U);
  EXPECT_EQ(grid.grid().width_cells, 0);
  EXPECT_GE(grid.room().high.x, 51);
  EXPECT_FALSE(grid.cover({0.0, 0.0}, std::vector<BeamWay>{{{5000.0, 5000.0}, true}}));
  EXPECT_TRUE(grid.add({0.0, 0.0}, {}));
}

}  // namespace
}  // namespace beaconless
