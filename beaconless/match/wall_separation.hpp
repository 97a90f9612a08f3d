// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/match/protection_level.hpp"
#include "beaconless/match/wall_rest.hpp"

namespace beaconless {

/// What separation tells of a pose.
struct Separated {
  ProtectionLevel level;
  WallRest furthest;  ///< of those that were left out, the one without which the pose goes furthest
};

/// How far a pose may be off: the furthest that it goes where a part of the beams is left out, and what the
/// rest leaves uncertain there.
///
/// In: the pieces of a scan; `is_fitted` where the pose is their best, so that lines may all be off by what
/// they differ by (jackknife). Left out by turns: nothing; each line of walls; each octant of bearing. Where
/// the rest does not determine the pose, nothing bounds it. Where a line is off by more than noise explains,
/// also every two of the twelve that tell most, unless the pose would be open without them. Out: `lines`, the
/// pieces of each line added up. Cost: a 3x3 system each. Source: Brown and McBurney, "Self-contained GPS
/// integrity check using maximum solution separation", NAVIGATION 1988; Efron, "The jackknife, the bootstrap
/// and other resampling plans", 1982. Differs: faults are groups of beams, and the separation itself stands
/// for its threshold.
Separated separate_walls(const SeparatedFit& fit, const ProtectionConfig& config,
                         std::span<const WallPiece> pieces, std::vector<WallPiece>& lines, bool is_fitted);

}  // namespace beaconless
