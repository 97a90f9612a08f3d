// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/segment2.hpp"

namespace beaconless {

/// A building as its walls: polylines of corners in the map frame, in metres.
///
/// A polyline that ends where it begins is a closed outline. Walls have no side and no thickness.
struct FloorPlan {
  using Polyline = std::vector<Eigen::Vector2d>;

  std::vector<Polyline> walls;
  double cell_m = 0.0;     ///< of the grid that the walls were read from; 0: they were measured
  double cells_rad = 0.0;  ///< heading of that grid's rows

  /// Every straight piece, in order; pieces of no length are left out.
  std::vector<Segment2> segments() const;

  /// Smallest and largest coordinates; both zero for an empty plan.
  struct Bounds {
    Eigen::Vector2d low = Eigen::Vector2d::Zero();
    Eigen::Vector2d high = Eigen::Vector2d::Zero();
  };
  Bounds bounds() const;

  friend bool operator==(const FloorPlan&, const FloorPlan&) = default;
};

}  // namespace beaconless
