// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/occupancy_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/map/oblique_heading.hpp"

namespace beaconless {
namespace {

constexpr double kFlat_cells = 0.5;   // from a wall, where M is 1
constexpr double kReach_cells = 1.5;  // … and where it ends
constexpr int kReach = 2;             // cells whose middles may be within reach of a point in this one
constexpr int kMargin_cells = 4;
constexpr double kFarthest_m = 1e6;

// What drawing moves walls by at an oblique heading: what poses in simulated rooms err by, less what noise
// does.
constexpr double kObliqueSigma_cells = 0.005;

void raise(OccupancyLevel& level, Cell cell, double value) {
  if (value > level.value(cell)) level.set(cell, value);
}

/// Calls `visit(Cell)` for a cell and those around it.
template <class Visit>
void each_near(Cell middle, Visit&& visit) {
  for (int y = middle.y - kReach; y <= middle.y + kReach; ++y)
    for (int x = middle.x - kReach; x <= middle.x + kReach; ++x) visit(Cell{x, y});
}

Eigen::Vector2d middle_cells(Cell cell) { return {cell.x + 0.5, cell.y + 0.5}; }

void clear(OccupancyLevel& level) {
  for (int y = level.low().y; y <= level.high().y; ++y)
    for (int x = level.low().x; x <= level.high().x; ++x) level.set({x, y}, 0.0);
}

Result<Done> check_plan(const FloorPlan& plan) {
  for (const FloorPlan::Polyline& wall : plan.walls)
    for (const Eigen::Vector2d& corner : wall)
      if (!(corner.cwiseAbs().maxCoeff() <= kFarthest_m))
        return Error{"map", "a corner of the floor plan is not finite or beyond 1000 km",
                     "check its coordinates"};
  if (plan.segments().empty())
    return Error{"map", "the floor plan has no walls", "a wall is two points or more"};
  return Done{};
}

/// One level of a floor plan, its rows at a heading.
Result<OccupancyLevel> level_of(const FloorPlan& plan, double resolution_m, double heading_rad) {
  OccupancyLevel level(resolution_m, {0.0, 0.0, heading_rad});
  const Eigen::Matrix2d cells_from_map = Pose2{0.0, 0.0, -heading_rad}.rotation() / resolution_m;
  FloorPlan cells = plan;
  for (FloorPlan::Polyline& wall : cells.walls)
    for (Eigen::Vector2d& corner : wall) corner = cells_from_map * corner;
  const FloorPlan::Bounds bounds = cells.bounds();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin_cells);
  if (auto room = level.cover(cell_of(bounds.low - margin), cell_of(bounds.high + margin)); !room)
    return room.error();
  clear(level);
  for (const Segment2& wall : cells.segments())
    traverse_cells(wall.a, wall.b, [&](Cell crossed) {
      each_near(crossed,
                [&](Cell cell) { raise(level, cell, wall_value(wall.distance_m(middle_cells(cell)), 1.0)); });
    });
  return level;
}

/// The cells of a grid as they are.
Result<OccupancyLevel> finest_of(const OccupancyGrid& grid) {
  OccupancyLevel level(grid.resolution_m, grid.map_from_grid);
  if (auto room = level.cover({0, 0}, {grid.width_cells - 1, grid.height_cells - 1}); !room)
    return room.error();
  for (int y = 0; y < grid.height_cells; ++y)
    for (int x = 0; x < grid.width_cells; ++x)
      if (const int percent = grid.at({x, y}); percent >= 0)
        level.set({x, y}, OccupancyLevel::value_of(std::min(percent, 100) / 100.0));
  return level;
}

/// The same cells as seen by cells `times` as large.
Result<OccupancyLevel> coarse_of(const OccupancyLevel& fine, int times) {
  OccupancyLevel level(times * fine.resolution_m(), fine.map_from_grid());
  const Cell last{fine.high().x / times, fine.high().y / times};
  if (auto room = level.cover({-kReach, -kReach}, {last.x + kReach, last.y + kReach}); !room)
    return room.error();
  for (int y = 0; y <= fine.high().y; ++y) {
    for (int x = 0; x <= fine.high().x; ++x) {
      if (!fine.is_known({x, y})) continue;
      const Cell above{x / times, y / times};
      if (!level.is_known(above)) level.set(above, 0.0);
      const double value = fine.value({x, y});
      if (value == 0.0) continue;
      const Eigen::Vector2d middle = middle_cells({x, y}) / times;
      each_near(above, [&](Cell cell) {
        raise(level, cell, value * wall_value((middle_cells(cell) - middle).norm(), 1.0));
      });
    }
  }
  return level;
}

Result<Done> check_grid(const OccupancyGrid& grid) {
  const bool is_whole = grid.width_cells > 0 && grid.height_cells > 0 &&
                        grid.occupancy_percent.size() == static_cast<std::size_t>(grid.width_cells) *
                                                             static_cast<std::size_t>(grid.height_cells);
  if (!is_whole)
    return Error{"map",
                 "the grid is " + std::to_string(grid.width_cells) + " x " +
                     std::to_string(grid.height_cells) + " cells and holds " +
                     std::to_string(grid.occupancy_percent.size()),
                 "a grid has at least one cell, and as many as its width times its height"};
  if (!(grid.resolution_m > 0.0) || !std::isfinite(grid.resolution_m) || !grid.map_from_grid.is_finite())
    return Error{"map", "the grid's resolution or origin is not a finite number", "a resolution is above 0"};
  return Done{};
}

}  // namespace

void describe(Fields& fields, PyramidConfig& config) {
  fields("levels", config.levels, {1, 8}, "grids that are matched on, each half as fine as the one before");
  fields("resolution_m", config.resolution_m, {0.005, 1.0},
         "side of the finest cells of a floor plan; a grid map has its own");
}

double wall_value(double distance_m, double resolution_m) {
  return std::clamp((kReach_cells - distance_m / resolution_m) / (kReach_cells - kFlat_cells), 0.0, 1.0);
}

Result<OccupancyPyramid> build_pyramid(const FloorPlan& plan, const PyramidConfig& config) {
  if (auto checked = check_config(config); !checked) return checked.error();
  if (auto checked = check_plan(plan); !checked) return checked.error();
  const double heading_rad = oblique_heading_rad(plan, config.resolution_m);
  OccupancyPyramid pyramid;
  pyramid.levels.reserve(static_cast<std::size_t>(config.levels));
  double resolution_m = config.resolution_m;
  for (int i = 0; i < config.levels; ++i, resolution_m *= 2.0) {
    auto level = level_of(plan, resolution_m, heading_rad);
    if (!level) return level.error();
    pyramid.levels.push_back(std::move(level).value());
  }
  pyramid.wall_sigma_m = kObliqueSigma_cells * config.resolution_m;
  return pyramid;
}

Result<OccupancyPyramid> build_pyramid(const OccupancyGrid& grid, const PyramidConfig& config) {
  if (auto checked = check_config(config); !checked) return checked.error();
  if (auto checked = check_grid(grid); !checked) return checked.error();
  OccupancyPyramid pyramid;
  pyramid.levels.reserve(static_cast<std::size_t>(config.levels));
  auto finest = finest_of(grid);
  if (!finest) return finest.error();
  pyramid.levels.push_back(std::move(finest).value());
  for (int i = 1, times = 2; i < config.levels; ++i, times *= 2) {
    auto level = coarse_of(pyramid.levels.front(), times);
    if (!level) return level.error();
    pyramid.levels.push_back(std::move(level).value());
  }
  pyramid.wall_sigma_m = grid.resolution_m / std::sqrt(12.0);
  return pyramid;
}

}  // namespace beaconless
