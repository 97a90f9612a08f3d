// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "beaconless/match/wall_beams.hpp"
#include "beaconless/match/wall_marks.hpp"

namespace beaconless {

/// The sums of a Gauss-Newton step over some of a scan's beams, as nine numbers that can be added and taken
/// away.
struct PartialSums {
  std::array<double, 6> hessian{};   ///< xx, xy, yy, xt, yt, tt of Σ w J Jᵀ / variance
  std::array<double, 3> gradient{};  ///< Σ w J e / variance

  /// Σ w / (variance cos²): what is known of the way to the wall, 1/m².
  double across() const { return hessian[0] + hessian[2]; }

  PartialSums& operator+=(const PartialSums& other) {
    for (std::size_t i = 0; i < hessian.size(); ++i) hessian[i] += other.hessian[i];
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += other.gradient[i];
    return *this;
  }
};

/// Neighbouring beams on one wall, within one octant of bearing.
struct WallPiece {
  double nx = 0.0;  ///< as in WallBeams
  double ny = 0.0;
  double offset_m = 0.0;
  int octant = 0;         ///< 0 … 7, of the laser's own frame; in no order
  std::uint32_t end = 0;  ///< of its beams, which begin where those of the piece before end
  PartialSums sums;
};

/// Divides beams into pieces, and marks where sum_walls() is to leave its sums.
///
/// In: beams in the order of their bearings; octants end up to three beams late. Out: `pieces` without sums.
/// Cost: a look at the ends of each piece.
void divide(const WallBeams& beams, VectorLoop loop, WallMarks& marks, std::vector<WallPiece>& pieces);

/// Gives each piece the sums of its own beams from what sum_walls() left at the marks.
///
/// Cost: nine sums a mark, of which there are one or two a piece.
void add_up(const WallMarks& marks, std::vector<WallPiece>& pieces);

}  // namespace beaconless
