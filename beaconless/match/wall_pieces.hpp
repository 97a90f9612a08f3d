// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "beaconless/match/wall_beams.hpp"

namespace beaconless {

/// The sums of a Gauss-Newton step over some of a scan's beams, as ten numbers that can be added.
struct PartialSums {
  std::array<double, 6> hessian{};   ///< xx, xy, yy, xt, yt, tt of Σ w J Jᵀ / variance
  std::array<double, 3> gradient{};  ///< Σ w J e / variance
  double across = 0.0;               ///< Σ w / (variance cos²): what is known of the way to the wall, 1/m²

  PartialSums& operator+=(const PartialSums& other) {
    for (std::size_t i = 0; i < hessian.size(); ++i) hessian[i] += other.hessian[i];
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += other.gradient[i];
    across += other.across;
    return *this;
  }
};

/// Neighbouring beams on one wall, within one octant of bearing.
struct WallPiece {
  double nx = 0.0;  ///< as in WallBeams
  double ny = 0.0;
  double offset_m = 0.0;
  int octant = 0;  ///< 0 … 7, of the laser's own frame; in no order
  PartialSums sums;
};

/// Sums the beams piece by piece, in their order, with the laser moved by `step` from where they were paired.
///
/// In: as for sum_walls(). Out: `pieces`, whose sums add up to those of sum_walls(); those without any weight
/// are left out. Cost: two thirds of sum_walls(). Along one wall J = (n, τ) / cos β, so that five sums tell
/// what nine would.
void sum_pieces(const WallBeams& beams, const Pose2& step, double cut, VectorLoop loop,
                std::vector<WallPiece>& pieces);

}  // namespace beaconless
