// SPDX-License-Identifier: Apache-2.0
// Many matches at once are the same matches.
#include "beaconless/match/walls_batch.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// Scans from many places in a room, some of them with nothing in them.
struct Fleet {
  Fleet() {
    const RayCaster caster(test::niche_room().segments());
    Rng rng(17);
    for (int robot = 0; robot < 53; ++robot) {
      const Pose2 truth{rng.uniform(0.8, 5.0), rng.uniform(0.8, 3.0), rng.uniform(-kPi, kPi)};
      scans.push_back(robot % 11 == 5
                          ? std::vector<Eigen::Vector2d>{}
                          : test::points_of(Scan::make(test::sweep(caster, truth, 0.01, rng)).value()));
      tasks.push_back(
          {{}, {truth.x_m + 0.01, truth.y_m - 0.01, truth.theta_rad}, robot % 3 == 0 ? 0.1 : 0.02});
    }
    for (std::size_t i = 0; i < scans.size(); ++i) tasks[i].points = scans[i];
  }

  WallIndex index{test::niche_room()};
  WallsConfig config;
  std::vector<std::vector<Eigen::Vector2d>> scans;
  std::vector<WallsTask> tasks;
};

bool are_same_bits(const MatchResult& one, const MatchResult& other) {
  return std::memcmp(&one.map_from_laser, &other.map_from_laser, sizeof(Pose2)) == 0 &&
         std::memcmp(one.covariance.data(), other.covariance.data(), sizeof(double) * 9) == 0 &&
         one.status == other.status && one.iterations == other.iterations &&
         one.pair_count == other.pair_count && one.misfit == other.misfit &&
         one.on_map_ratio == other.on_map_ratio;
}

TEST(WallsBatch, GivesTheBitsOfSingleMatches) {
  const Fleet fleet;
  WallsScratch scratch;
  std::vector<MatchResult> results(fleet.tasks.size());
  match_walls_all(fleet.tasks, fleet.index, fleet.config, scratch, results);
  int usable = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const WallsTask& task = fleet.tasks[i];
    WallsScratch own;
    const MatchResult single =
        match_walls(task.points, fleet.index, task.guess, task.prior_m, fleet.config, own);
    EXPECT_TRUE(are_same_bits(results[i], single)) << i;
    usable += results[i].usable() ? 1 : 0;
  }
  EXPECT_EQ(usable, 48);
}

TEST(WallsBatch, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Fleet fleet;
  WallsScratch scratch;
  std::vector<MatchResult> one(fleet.tasks.size());
  match_walls_all(fleet.tasks, fleet.index, fleet.config, scratch, one);
  for (const std::size_t threads : {1, 2, 3, 7, 60}) {
    std::vector<WallsScratch> scratches(threads);
    std::vector<MatchResult> many(fleet.tasks.size());
    match_walls_all(fleet.tasks, fleet.index, fleet.config, scratches, many);
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_TRUE(are_same_bits(one[i], many[i])) << threads << " threads, task " << i;
  }
}

TEST(WallsBatch, AllocatesNothingOnceGrown) {
  const Fleet fleet;
  WallsScratch scratch;
  std::vector<MatchResult> results(fleet.tasks.size());
  match_walls_all(fleet.tasks, fleet.index, fleet.config, scratch, results);
  const std::size_t before = test::allocations();
  match_walls_all(fleet.tasks, fleet.index, fleet.config, scratch, results);
  EXPECT_EQ(test::allocations(), before);
}

TEST(WallsBatch, OfNothingLeavesNothingBehind) {
  const Fleet fleet;
  std::vector<WallsScratch> scratches(2);
  match_walls_all({}, fleet.index, fleet.config, scratches, {});
  for (const WallsScratch& scratch : scratches) EXPECT_EQ(scratch.beams.count, 0U);
}

}  // namespace
}  // namespace beaconless
