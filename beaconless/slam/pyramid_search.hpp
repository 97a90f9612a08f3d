// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/occupancy_level.hpp"

namespace beaconless {

/// The window around a guess that is searched on a level of a pyramid.
struct PyramidSearchConfig {
  double window_m = 0.6;
  double window_deg = 30.0;
  double step_deg = 1.5;      ///< a cell of 20 cm at 7.6 m
  int points = 180;           ///< of the scan, evenly taken
  double far_penalty = 0.05;  ///< what a pose at the window's edge must fit better by
  int keep = 5;               ///< best poses to return
};

void describe(Fields& fields, PyramidSearchConfig& config);

/// A pose that the search found.
struct FoundPose {
  Pose2 map_from_laser;
  double score = 0.0;  ///< -1 … 1; greater is better
};

/// Buffers that live on from call to call, so that a search allocates nothing.
struct PyramidSearchScratch {
  std::vector<Eigen::Vector2d> points;
  std::vector<Cell> cells;
  std::vector<FoundPose> tried;
};

/// Scores every pose of a window around a guess by how many of the scan's points fall on obstacles of a level
/// less those that fall where it is free, and gives the best ones, best first, no two of them neighbours.
///
/// Poses are a cell apart. In: points in the laser frame; a finite guess. Cost: poses x points look-ups (with
/// 20 cm cells 2009 x 180 by default, about a millisecond). Source: Olson, "Real-time correlative scan
/// matching", 2009: one level, points turned once a heading. Differs: what is free counts against a pose,
/// what is unknown does not, since the map is not finished.
void search_pyramid(std::span<const Eigen::Vector2d> points, const OccupancyLevel& level, const Pose2& guess,
                    const PyramidSearchConfig& config, PyramidSearchScratch& scratch,
                    std::vector<FoundPose>& found);

}  // namespace beaconless
