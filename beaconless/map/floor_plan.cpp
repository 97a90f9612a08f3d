// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/floor_plan.hpp"

namespace beaconless {

std::vector<Segment2> FloorPlan::segments() const {
  std::vector<Segment2> segments;
  for (const Polyline& wall : walls)
    for (std::size_t i = 1; i < wall.size(); ++i)
      if (wall[i] != wall[i - 1]) segments.push_back({wall[i - 1], wall[i]});
  return segments;
}

FloorPlan::Bounds FloorPlan::bounds() const {
  Bounds bounds;
  bool first = true;
  for (const Polyline& wall : walls) {
    for (const Eigen::Vector2d& corner : wall) {
      bounds.low = first ? corner : bounds.low.cwiseMin(corner);
      bounds.high = first ? corner : bounds.high.cwiseMax(corner);
      first = false;
    }
  }
  return bounds;
}

}  // namespace beaconless
