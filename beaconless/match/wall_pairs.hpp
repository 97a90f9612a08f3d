// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/walls.hpp"

namespace beaconless {

/// How well all points lie on the map, where they were paired.
struct WallPairing {
  double on_map_ratio = 0.0;  ///< see MatchResult
  double misfit = 1.0;
  double wall_variance_m2 = 0.0;  ///< of the walls that were hit, the mean over beams
};

/// Pairs every beam with the wall that it hits from a pose; `beams` then holds those that hit one.
///
/// In: ends of beams in the laser frame; a loop that this processor knows. Beams that end further than
/// `gate_m` beside a wall do not hit it. A beam that is within three standard deviations of the wall of the
/// beam before it, where no other wall is near, is on that wall; any other is looked up. Cost: four beams at
/// once on one wall, a look-up for any other.
WallPairing pair_with_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                            const Pose2& map_from_laser, double gate_m, const WallsConfig& config,
                            WallBeams& beams, VectorLoop loop);

}  // namespace beaconless
