// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

int floor_to_int(double value) { return static_cast<int>(std::floor(std::clamp(value, -1e9, 1e9))); }

}  // namespace

Cell OccupancyGrid::cell_at(const Eigen::Vector2d& point_map) const {
  const Eigen::Vector2d point = map_from_grid.inverse() * point_map / resolution_m;
  return {floor_to_int(point.x()), floor_to_int(point.y())};
}

Eigen::Vector2d OccupancyGrid::center(Cell cell) const {
  return map_from_grid * Eigen::Vector2d(resolution_m * (cell.x + 0.5), resolution_m * (cell.y + 0.5));
}

}  // namespace beaconless
