// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <Eigen/Core>

#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// The cell of a point given in cells (cell (0, 0) reaches from 0 to 1); the point is finite and within ±1e9.
inline Cell cell_of(const Eigen::Vector2d& point_cells) {
  return {static_cast<int>(std::floor(point_cells.x())), static_cast<int>(std::floor(point_cells.y()))};
}

/// Calls `visit(Cell)` for every cell that the straight way crosses, in order, both ends included.
///
/// In: points in cells, finite and within ±1e9. Exactly |dx| + |dy| + 1 cells, each the neighbour of the one
/// before by a side; a way back visits the same cells. Where the way passes through a corner, of the two
/// cells beside it the upper one is taken. Source: Amanatides and Woo, "A fast voxel traversal algorithm for
/// ray tracing", Eurographics 1987. Differs: the steps are counted, so that rounding can neither miss the
/// last cell nor run past it.
template <class Visit>
void traverse_cells(const Eigen::Vector2d& from_cells, const Eigen::Vector2d& to_cells, Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Cell cell = cell_of(from_cells);
  const Cell last = cell_of(to_cells);
  const Eigen::Vector2d way = to_cells - from_cells;
  const int step_x = last.x < cell.x ? -1 : 1;
  const int step_y = last.y < cell.y ? -1 : 1;
  std::int64_t left_x = std::abs(std::int64_t{last.x} - cell.x);
  std::int64_t left_y = std::abs(std::int64_t{last.y} - cell.y);

  // The share of the way at which the next cell border is met; from the border itself, so that errors do not
  // add up.
  const auto next_x = [&] {
    return left_x == 0 ? kNever : (cell.x + (step_x > 0) - from_cells.x()) / way.x();
  };
  const auto next_y = [&] {
    return left_y == 0 ? kNever : (cell.y + (step_y > 0) - from_cells.y()) / way.y();
  };

  visit(cell);
  double t_x = next_x();
  double t_y = next_y();
  while (left_x + left_y > 0) {
    const bool along_x = t_x < t_y || (t_x == t_y && step_y < 0);
    if (left_y == 0 || (left_x > 0 && along_x)) {
      cell.x += step_x;
      --left_x;
      t_x = next_x();
    } else {
      cell.y += step_y;
      --left_y;
      t_y = next_y();
    }
    visit(cell);
  }
}

/// Calls `visit(Cell)` for the cells of Bresenham's line, in order, both ends included: max(|dx|, |dy|) + 1
/// cells, each a neighbour of the one before by a side or a corner. It skips cells that the exact way only
/// grazes.
///
/// Source: Bresenham 1965; dissertation Algorithm 8.
/// Differs: the printed algorithm adds 2 dy only where y did not step and so ends below the last cell; here
/// it is added on every step. It also knows the first octant only; here all eight.
template <class Visit>
void bresenham_cells(Cell from, Cell to, Visit&& visit) {
  const std::int64_t dx = std::abs(std::int64_t{to.x} - from.x);
  const std::int64_t dy = std::abs(std::int64_t{to.y} - from.y);
  const int step_x = to.x < from.x ? -1 : 1;
  const int step_y = to.y < from.y ? -1 : 1;
  const bool steep = dy > dx;
  const std::int64_t longer = steep ? dy : dx;
  const std::int64_t shorter = steep ? dx : dy;
  std::int64_t excess = 2 * shorter - longer;
  Cell cell = from;
  visit(cell);
  for (std::int64_t i = 0; i < longer; ++i) {
    if (excess > 0) {
      (steep ? cell.x : cell.y) += steep ? step_x : step_y;
      excess -= 2 * longer;
    }
    (steep ? cell.y : cell.x) += steep ? step_y : step_x;
    excess += 2 * shorter;
    visit(cell);
  }
}

}  // namespace beaconless
