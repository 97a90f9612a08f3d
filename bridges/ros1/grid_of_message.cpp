// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/grid_of_message.hpp"

#include <cmath>

#include <fmt/format.h>

#include "beaconless/io/quaternion_yaw.hpp"
#include "beaconless/map/rasterize.hpp"

#include "bridges/ros1/told.hpp"

namespace beaconless::ros1 {
namespace {

constexpr std::uint64_t kMostCells = std::uint64_t{1} << 28U;

}  // namespace

Result<OccupancyGrid> grid_of_message(const GridMessage& message) {
  const std::uint64_t cells = std::uint64_t{message.width_cells} * message.height_cells;
  if (cells == 0 || cells > kMostCells || cells != message.percent.size())
    return Error{"map",
                 fmt::format("it says {} x {} cells and brings {}", message.width_cells, message.height_cells,
                             message.percent.size()),
                 "at most 2^28 cells, and as many as it says"};
  if (!(message.resolution_m > 0.0) || !std::isfinite(message.resolution_m))
    return Error{"map", fmt::format("its cells are {} m large", message.resolution_m), ""};
  const Transform& at = message.origin;
  const auto yaw_rad = io::yaw_rad_of_quaternion(at.qx, at.qy, at.qz, at.qw);
  if (!yaw_rad || !std::isfinite(at.x_m) || !std::isfinite(at.y_m))
    return Error{"map", "its origin is not finite, or has a quaternion of length zero",
                 "for no turn write 0, 0, 0, 1"};
  OccupancyGrid grid;
  grid.resolution_m = message.resolution_m;
  grid.map_from_grid = {at.x_m, at.y_m, *yaw_rad};
  grid.width_cells = static_cast<int>(message.width_cells);
  grid.height_cells = static_cast<int>(message.height_cells);
  grid.occupancy_percent = message.percent;
  for (std::int8_t& percent : grid.occupancy_percent)
    if (percent < OccupancyGrid::kUnknown || percent > OccupancyGrid::kOccupied)
      percent = OccupancyGrid::kUnknown;
  return grid;
}

Result<GridMessage> message_of_map(const Map& map, const std::string& frame) {
  if (const auto* plan = std::get_if<FloorPlan>(&map)) {
    const auto drawn = rasterize(*plan);
    return drawn ? message_of_map(*drawn, frame) : drawn.error();
  }
  const auto& grid = std::get<OccupancyGrid>(map);
  return GridMessage{frame,
                     grid.resolution_m,
                     static_cast<std::uint32_t>(grid.width_cells),
                     static_cast<std::uint32_t>(grid.height_cells),
                     transform_of(grid.map_from_grid),
                     grid.occupancy_percent};
}

}  // namespace beaconless::ros1
