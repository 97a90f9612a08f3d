// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/match/protection_level.hpp"
#include "beaconless/match/wall_pieces.hpp"

namespace beaconless {

/// What is known of a fit of walls besides its sums.
struct SeparatedFit {
  double variance_factor = 1.0;  ///< of the pose, over the inverse of Σ w J Jᵀ / variance
  double curvature = 1.0;        ///< mean of that of the beams' losses, over the mean weight
  double map_sigma_m = 0.0;      ///< of what all walls may be off by alike
  double arm_m = 1.0;            ///< root mean square distance of the beams
};

/// Buffers that live on from call to call.
struct SeparationScratch {
  std::vector<WallPiece> pieces;
  std::vector<WallPiece> lines;
};

/// How far a fit may be off: the furthest that the pose goes where a part of the beams is left out, and what
/// the rest leaves uncertain there.
///
/// In: the pieces in the scratch, at the fit. Left out by turns: each line of walls; each octant of bearing,
/// and each two of them; all pieces that are plainly short of their walls; all that are plainly beside them.
/// Where a rest does not determine the pose nothing bounds it. All lines together may be off by what they
/// differ by (jackknife). Cost: a 3x3 system each. Source: Joerger and Pervan, "Kalman filter residual-based
/// integrity monitoring", 2013, and Brown, "Solution separation", for satellites (the separation, and the
/// level as its size plus K standard deviations of the rest's); Efron, "The jackknife", 1982. Differs: faults
/// are groups of beams; the measured separation stands in for its threshold.
ProtectionLevel separate_walls(const SeparatedFit& fit, const ProtectionConfig& config,
                               SeparationScratch& scratch);

}  // namespace beaconless
