// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/rasterize.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "beaconless/map/grid_traversal.hpp"

namespace beaconless {
namespace {

constexpr double kFarthest_m = 1e6;

Result<Done> check_walls(const FloorPlan& plan) {
  for (const FloorPlan::Polyline& wall : plan.walls)
    for (const Eigen::Vector2d& corner : wall)
      if (!(corner.cwiseAbs().maxCoeff() <= kFarthest_m))
        return Error{"rasterize",
                     "a corner of the floor plan is at (" + std::to_string(corner.x()) + ", " +
                         std::to_string(corner.y()) + ")",
                     "corners are finite and within 1000 km of the origin"};
  if (plan.segments().empty())
    return Error{"rasterize", "the floor plan has no walls", "a wall is two points or more"};
  return Done{};
}

}  // namespace

void describe(Fields& fields, RasterConfig& config) {
  fields("resolution_m", config.resolution_m, {0.001, 10.0}, "side of a cell");
  fields("heading_rad", config.heading_rad, {-7.0, 7.0}, "heading of the grid's rows in the map");
  fields("margin_m", config.margin_m, {0.0, 1000.0}, "free cells around the outermost walls");
  fields("phase_x_cells", config.phase_x_cells, {0.0, 1.0},
         "where in its cell the map's origin lies, along x");
  fields("phase_y_cells", config.phase_y_cells, {0.0, 1.0},
         "where in its cell the map's origin lies, along y");
}

Result<OccupancyGrid> rasterize(const FloorPlan& plan, const RasterConfig& config) {
  if (auto checked = check_config(config); !checked) return checked.error();
  if (auto checked = check_walls(plan); !checked) return checked.error();

  // 1. The walls in cells of a lattice that has the map's origin at the chosen place in its cell (0, 0).
  const Eigen::Vector2d phase(config.phase_x_cells, config.phase_y_cells);
  const Eigen::Matrix2d cells_from_map =
      Pose2{0.0, 0.0, -config.heading_rad}.rotation() / config.resolution_m;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Segment2& wall : plan.segments()) {
    for (const Eigen::Vector2d& corner : {wall.a, wall.b}) {
      const Eigen::Vector2d cells = cells_from_map * corner + phase;
      low = low.cwiseMin(cells);
      high = high.cwiseMax(cells);
    }
  }

  // 2. The part of the lattice around them.
  const double margin_cells = std::ceil(config.margin_m / config.resolution_m);
  low = low.array().floor() - margin_cells;
  high = high.array().floor() + margin_cells + 1.0;
  const Eigen::Vector2d size = high - low;
  if (size.x() * size.y() > static_cast<double>(kMaxRasterCells))
    return Error{"rasterize",
                 "the grid would have " + std::to_string(static_cast<std::int64_t>(size.x())) + " x " +
                     std::to_string(static_cast<std::int64_t>(size.y())) + " cells",
                 "at most " + std::to_string(kMaxRasterCells) + " in all: raise resolution_m"};
  OccupancyGrid grid;
  grid.resolution_m = config.resolution_m;
  const Eigen::Vector2d corner = Pose2{0.0, 0.0, config.heading_rad} * ((low - phase) * config.resolution_m);
  grid.map_from_grid = {corner.x(), corner.y(), wrap_angle(config.heading_rad)};
  grid.width_cells = static_cast<int>(size.x());
  grid.height_cells = static_cast<int>(size.y());
  grid.occupancy_percent.assign(
      static_cast<std::size_t>(grid.width_cells) * static_cast<std::size_t>(grid.height_cells),
      OccupancyGrid::kFree);

  // 3. The cells under each wall.
  const Eigen::Vector2d shift = phase - low;
  for (const Segment2& wall : plan.segments())
    traverse_cells(cells_from_map * wall.a + shift, cells_from_map * wall.b + shift, [&](Cell cell) {
      if (grid.contains(cell)) grid.occupancy_percent[grid.index(cell)] = OccupancyGrid::kOccupied;
    });
  return grid;
}

}  // namespace beaconless
