// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/walls_batch.hpp"

#include <thread>
#include <vector>

namespace beaconless {

void match_walls_all(std::span<const WallsTask> tasks, const WallIndex& walls, const WallsConfig& config,
                     WallsScratch& scratch, std::span<MatchResult> results) {
  for (std::size_t i = 0; i < tasks.size(); ++i)
    results[i] = match_walls(tasks[i].points, walls, tasks[i].guess, tasks[i].prior_m, config, scratch);
}

void match_walls_all(std::span<const WallsTask> tasks, const WallIndex& walls, const WallsConfig& config,
                     std::span<WallsScratch> scratches, std::span<MatchResult> results) {
  const auto run_block = [&](std::size_t block) {
    const std::size_t begin = block * tasks.size() / scratches.size();
    const std::size_t count = (block + 1) * tasks.size() / scratches.size() - begin;
    match_walls_all(tasks.subspan(begin, count), walls, config, scratches[block],
                    results.subspan(begin, count));
  };
  std::vector<std::jthread> threads;  // joined however this ends
  threads.reserve(scratches.size());
  for (std::size_t block = 1; block < scratches.size(); ++block) threads.emplace_back(run_block, block);
  run_block(0);
}

}  // namespace beaconless
