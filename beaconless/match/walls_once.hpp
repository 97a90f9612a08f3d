// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "beaconless/geometry/segment2.hpp"
#include "beaconless/match/thin_walls.hpp"

namespace beaconless {

/// Puts the pieces of outlines together into walls that are there once, in cells.
///
/// A piece of a thin wall becomes the whole wall, and what lies on a longer wall is a part of that: the other
/// side of a thin wall, and what is left of it between the things that stand against it.
class WallsOnce {
 public:
  explicit WallsOnce(const ThinWalls& thin) : thin_(thin) {}

  void add(const Segment2& piece, const std::optional<ThinWall>& wall);

  /// Cost: the pieces times those near each.
  std::vector<Segment2> walls() const;

 private:
  const ThinWalls& thin_;
  std::vector<Segment2> pieces_;
};

}  // namespace beaconless
