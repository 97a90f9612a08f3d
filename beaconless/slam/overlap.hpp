// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/occupancy_level.hpp"

namespace beaconless {

/// Where the points of a scan fall in a map that is not finished; shares of all points.
struct Overlap {
  double on_ratio = 0.0;   ///< on a known obstacle, or in a cell beside one
  double off_ratio = 0.0;  ///< where the map knows that nothing stands: the map is wrong there, or the pose

  double new_ratio() const { return 1.0 - on_ratio - off_ratio; }  ///< where nothing is known yet

  /// How far the map speaks for the pose, -1 … 1. What is new says nothing.
  double score() const { return on_ratio - off_ratio; }

  /// Of the points that the map can speak of, the share that it explains; 1 for none.
  double explained_ratio() const {
    const double known = on_ratio + off_ratio;
    return known > 0.0 ? on_ratio / known : 1.0;
  }
};

/// In: points in the laser frame; a finite pose. All new for no points. Cost: four cells a point.
Overlap overlap_of(std::span<const Eigen::Vector2d> points, const OccupancyLevel& level,
                   const Pose2& map_from_laser);

}  // namespace beaconless
