// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/protection_level.hpp"
#include "beaconless/match/walls.hpp"

namespace beaconless {

/// What a fit of walls leaves behind for its protection level.
struct FittedWalls {
  Pose2 paired_at;      ///< map_from_laser where the beams were paired …
  Pose2 step;           ///< … and how it moved from there
  double weight = 0.0;  ///< Σ w of all beams
  SeparatedFit known;
};

/// How far a fit may be off, by what its parts say of it, and by what the beams say that it left out.
///
/// In: all ends of beams in the laser frame; the marked pieces in the scratch, added up. Where more beams
/// count for little than noise explains, every fourth is paired once more, with walls as far as twice the
/// gate, and all weigh nearly alike: of a wall that is wrong and the many that it outweighs, only that shows
/// the many. Near corners they are paired wrongly as long as the pose is wrong: so once or twice again from
/// where the furthest part puts it. Cost: of separation; where beams were left out, a quarter of a pairing
/// each time.
ProtectionLevel protect_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                              const FittedWalls& fit, const WallsConfig& config, WallsScratch& scratch);

}  // namespace beaconless
