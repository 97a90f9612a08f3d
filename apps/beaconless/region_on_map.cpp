// SPDX-License-Identifier: Apache-2.0
#include "region_on_map.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace beaconless::cli {
namespace {

Eigen::AlignedBox2d box_of(const FloorPlan& plan) {
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

Result<Done> check_on_map(std::string_view words, const SearchRegion& region, const Map& map) {
  const Eigen::AlignedBox2d box = std::visit([](const auto& of) { return box_of(of); }, map);
  // A map without walls is refused elsewhere.
  if (box.isEmpty() || box.exteriorDistance(region.middle) <= region.radius_m) return Done{};
  return Error{"--start",
               fmt::format("\"{}\" lies wholly off the map, whose walls are between {:.1f},{:.1f} and "
                           "{:.1f},{:.1f}",
                           words, box.min().x(), box.min().y(), box.max().x(), box.max().y()),
               "write near:x,y,radius in metres of the map's frame, or auto"};
}

}  // namespace beaconless::cli
