// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/walls.hpp"

namespace beaconless {

/// A scan of one of many robots, or one of many places where a robot may be.
struct WallsTask {
  std::span<const Eigen::Vector2d> points;  ///< ends of beams in the laser frame
  Pose2 guess;                              ///< map_from_laser
  double prior_m = 0.0;                     ///< see match_walls
};

/// Fits many scans to the same walls, one after the other.
///
/// In: a result for every task. Out: bit for bit what match_walls gives for each. Cost: that of match_walls;
/// allocates nothing once the scratch has held the longest scan.
void match_walls_all(std::span<const WallsTask> tasks, const WallIndex& walls, const WallsConfig& config,
                     WallsScratch& scratch, std::span<MatchResult> results);

/// The same at once, with a thread for every scratch.
///
/// Each thread has as many tasks as any other, one block of them fixed by their number alone: the results are
/// the same bits for any number of scratches. In: at least one scratch. Cost: starting the threads, some 20
/// us each and an allocation; worth it from a hundred tasks on.
void match_walls_all(std::span<const WallsTask> tasks, const WallIndex& walls, const WallsConfig& config,
                     std::span<WallsScratch> scratches, std::span<MatchResult> results);

}  // namespace beaconless
