// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/segment2.hpp"

namespace beaconless {

/// A place at which a wall meets another one.
struct WallContact {
  std::uint32_t wall = 0;
  double along_m = 0.0;                             ///< from the wall's first end
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< the end of the other wall, or the crossing

  friend bool operator==(const WallContact&, const WallContact&) = default;
};

/// Where walls meet: where an end lies within `join_m` of another wall, and where two cross.
///
/// Out: ordered by wall, then along it; each place once for each of the walls that meet there, except that an
/// end is not told of its own wall. In: finite walls of some length. Cost: O(n log n) for walls of similar
/// lengths that are spread out, whatever the extent.
std::vector<WallContact> find_wall_contacts(std::span<const Segment2> walls, double join_m);

}  // namespace beaconless
