// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/match/protection_level.hpp"
#include "beaconless/match/wall_rest.hpp"

namespace beaconless {

/// How far a pose may be off: the furthest that it goes where a part of the beams is left out, and what the
/// rest leaves uncertain there.
///
/// In: the pieces of a scan; `is_fitted` where the pose is their best, so that lines may all be off by what
/// they differ by (jackknife). Left out by turns: nothing; each line of walls; each octant of bearing. Where
/// the rest does not determine the pose, nothing bounds it. Out: `lines`, the pieces of each line added up.
/// Cost: a 3x3 system each. Source: Brown and McBurney, "Self-contained GPS integrity check using maximum
/// solution separation", NAVIGATION 1988; Efron, "The jackknife, the bootstrap and other resampling plans",
/// 1982. Differs: faults are groups of beams, and the separation itself stands for its threshold.
ProtectionLevel separate_walls(const SeparatedFit& fit, const ProtectionConfig& config,
                               std::span<const WallPiece> pieces, std::vector<WallPiece>& lines,
                               bool is_fitted);

}  // namespace beaconless
