// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/floor_plan.hpp"

namespace beaconless {

/// The walls of a plan cut at every place where one meets another.
struct WallGraph {
  /// A piece of wall as it leaves a node.
  struct Arm {
    double direction_rad = 0.0;  ///< in [-pi, pi); of the wall, not of the two nodes
    double length_m = 0.0;
    std::uint32_t node = 0;  ///< where it leads
  };

  std::vector<Eigen::Vector2d> nodes;  ///< map frame; ends, and places where walls meet
  std::vector<std::uint32_t> first;    ///< first[n] … first[n + 1]: the part of `arms` that leaves node n
  std::vector<Arm> arms;               ///< of each node counter-clockwise; no two to the same node

  std::span<const Arm> arms_of(std::size_t node) const {
    return std::span(arms).subspan(first[node], first[node + 1] - first[node]);
  }
};

/// Cuts the walls of a plan where they cross and where an end lies within `join_m` of another wall; ends and
/// cuts within `join_m` of each other are one node.
///
/// Pieces shorter than `join_m` may vanish, pieces drawn twice are one, walls that are not finite or beyond
/// 1e8 m are left out. Cost: O(n log n) for walls of similar lengths.
WallGraph build_wall_graph(const FloorPlan& plan, double join_m);

}  // namespace beaconless
