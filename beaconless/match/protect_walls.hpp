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
  double cut = 6.0;     ///< of Tukey's weights, in standard deviations of a beam
  double weight = 0.0;  ///< Σ w of all beams
  SeparatedFit known;
};

/// How far a fit may be off, by what its parts say of it, and by what the beams say that it left out.
///
/// In: all ends of beams in the laser frame; the paired beams in the scratch. Where more beams count for
/// little than noise explains, every fourth is paired once more, with walls as far as twice the gate, and all
/// weigh alike: of a wall that is wrong and the many that it outweighs, only that shows the many. Cost: two
/// thirds of a step over the beams; where beams were left out, a quarter of a pairing more.
ProtectionLevel protect_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                              const FittedWalls& fit, const WallsConfig& config, WallsScratch& scratch);

}  // namespace beaconless
