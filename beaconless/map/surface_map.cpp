// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/surface_map.hpp"

#include <utility>

namespace beaconless {

Result<SurfaceMap> build_surface_map(const Map& map, double reach_m) {
  if (const auto* plan = std::get_if<FloorPlan>(&map)) {
    WallIndex walls(*plan, reach_m);
    if (walls.wall_count() == 0)
      return Error{"map", "the floor plan has no walls", "a wall is two points or more"};
    return SurfaceMap(std::move(walls));
  }
  CellIndex cells(std::get<OccupancyGrid>(map), reach_m);
  if (cells.surface_count() == 0)
    return Error{"map", "the grid has no occupied cell",
                 "check occupied_thresh and negate of the map's YAML"};
  return SurfaceMap(std::move(cells));
}

FloorPlan::Bounds bounds_of(const SurfaceMap& map) {
  return std::visit([](const auto& index) -> FloorPlan::Bounds { return index.bounds(); }, map);
}

}  // namespace beaconless
