// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "beaconless/map/rasterize.hpp"

namespace beaconless {
namespace {

constexpr double kPlanCell_m = 0.1;
constexpr double kMostCells = 4e6;
constexpr double kLeastShutIn = 0.25;  // of the box around a plan

std::vector<Cell> free_cells(const OccupancyGrid& grid) {
  std::vector<Cell> cells;
  for (int y = 0; y < grid.height_cells; ++y)
    for (int x = 0; x < grid.width_cells; ++x)
      if (grid.is_free({x, y})) cells.push_back({x, y});
  return cells;
}

/// Makes unknown what can be reached from the rim without crossing a wall.
void forget_outside(OccupancyGrid& grid) {
  std::vector<Cell> reached{{0, 0}};
  grid.occupancy_percent[0] = OccupancyGrid::kUnknown;
  while (!reached.empty()) {
    const Cell cell = reached.back();
    reached.pop_back();
    for (const Cell next :
         {Cell{cell.x + 1, cell.y}, {cell.x - 1, cell.y}, {cell.x, cell.y + 1}, {cell.x, cell.y - 1}}) {
      if (!grid.contains(next) || !grid.is_free(next)) continue;
      grid.occupancy_percent[grid.index(next)] = OccupancyGrid::kUnknown;
      reached.push_back(next);
    }
  }
}

}  // namespace

FreeSpace::FreeSpace(const Map& map) {
  if (const auto* grid = std::get_if<OccupancyGrid>(&map)) {
    cell_m_ = grid->resolution_m;
    map_from_cells_ = grid->map_from_grid;
    cells_ = free_cells(*grid);
    return;
  }
  const auto& plan = std::get<FloorPlan>(map);
  const FloorPlan::Bounds bounds = plan.bounds();
  const Eigen::Vector2d size = bounds.high - bounds.low;
  cell_m_ =
      std::max({kPlanCell_m, std::sqrt(size.x() * size.y() / kMostCells), size.maxCoeff() / kMostCells});
  middle_ = 0.5 * (bounds.low + bounds.high);
  radius_m_ = 0.5 * size.norm();
  auto drawn = rasterize(plan, {.resolution_m = cell_m_});
  if (!drawn) return;
  map_from_cells_ = drawn->map_from_grid;
  OccupancyGrid shut_in = *drawn;
  forget_outside(shut_in);
  cells_ = free_cells(shut_in);
  if (area_m2() < kLeastShutIn * size.x() * size.y()) cells_ = free_cells(*drawn);
}

FreeSpace FreeSpace::within(const Eigen::Vector2d& middle, double radius_m) const {
  FreeSpace part = *this;
  part.middle_ = middle;
  part.radius_m_ = radius_m;
  std::erase_if(part.cells_, [&](const Cell& cell) {
    const Eigen::Vector2d at =
        map_from_cells_ * Eigen::Vector2d(cell_m_ * (cell.x + 0.5), cell_m_ * (cell.y + 0.5));
    return (at - middle).norm() > radius_m;
  });
  return part;
}

Pose2 FreeSpace::sample(Rng& rng) const {
  const double pick = rng.uniform();
  const double x = rng.uniform();
  const double y = rng.uniform();
  const double heading = rng.uniform(-kPi, kPi);
  if (cells_.empty()) {
    const double way_m = radius_m_ * std::sqrt(pick);
    const double angle = 2.0 * kPi * x;
    return {middle_.x() + way_m * std::cos(angle), middle_.y() + way_m * std::sin(angle), heading};
  }
  const Cell& cell = cells_[static_cast<std::size_t>(pick * static_cast<double>(cells_.size()))];
  const Eigen::Vector2d at =
      map_from_cells_ * Eigen::Vector2d(cell_m_ * (cell.x + x), cell_m_ * (cell.y + y));
  return {at.x(), at.y(), heading};
}

}  // namespace beaconless
