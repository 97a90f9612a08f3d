// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "beaconless/geometry/segment2.hpp"
#include "beaconless/match/thin_walls.hpp"

namespace beaconless {

/// Puts the pieces of outlines together into walls that are there once, in cells.
///
/// A piece of a thin wall becomes the whole wall. Left out is what shows nothing that longer walls do not:
/// the other side of a thin wall, what is left of it between things that stand against it, and the borders of
/// what lies between two walls that touch.
class WallsOnce {
 public:
  explicit WallsOnce(const ThinWalls& thin) : thin_(thin) {}

  /// In: a piece of an outline, the middles of the cells along it, and the thin wall of which it is a part.
  void add(const Segment2& piece, std::span<const Eigen::Vector2d> middles,
           const std::optional<ThinWall>& wall);

  /// Cost: the cells of the grid, and the pieces times those near each.
  std::vector<Segment2> walls() const;

 private:
  struct Whole {
    ThinWall wall;
    Segment2 between;
  };
  struct Other {
    Segment2 piece;
    std::vector<Eigen::Vector2d> middles;
  };

  const ThinWalls& thin_;
  std::vector<Whole> wholes_;
  std::vector<Other> others_;
};

}  // namespace beaconless
