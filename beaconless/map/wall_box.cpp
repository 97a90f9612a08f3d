// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_box.hpp"

namespace beaconless {
namespace {

Eigen::AlignedBox2d box_of(const FloorPlan& plan) {
  if (plan.segments().empty()) return {};
  const FloorPlan::Bounds bounds = plan.bounds();
  return {bounds.low, bounds.high};
}

Eigen::AlignedBox2d box_of(const OccupancyGrid& grid) {
  Eigen::AlignedBox2d box;
  for (int y = 0; y < grid.height_cells; ++y)
    for (int x = 0; x < grid.width_cells; ++x)
      if (grid.is_occupied({x, y})) box.extend(grid.center({x, y}));
  return box;
}

}  // namespace

Eigen::AlignedBox2d wall_box(const Map& map) {
  return std::visit([](const auto& of) { return box_of(of); }, map);
}

}  // namespace beaconless
