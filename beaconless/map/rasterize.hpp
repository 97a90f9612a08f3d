// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// How walls are drawn into cells.
struct RasterConfig {
  double resolution_m = 0.05;
  double heading_rad = 0.0;    ///< of the grid's rows in the map; see oblique_heading_rad()
  double margin_m = 0.5;       ///< free cells around the outermost walls
  double phase_x_cells = 0.5;  ///< where in its cell the map's origin lies; by default in the middle, so that
  double phase_y_cells = 0.5;  ///< walls a whole number of cells from it run through the middles of theirs
};

void describe(Fields& fields, RasterConfig& config);

/// Draws a floor plan into cells: those that a wall passes through are occupied, all others free.
///
/// A drawn wall is off by up to half a cell. Where it runs along the rows all its cells are off by the same;
/// where it runs oblique to them the offsets change from cell to cell and average out.
/// Errors: no walls, a corner that is not finite or beyond 1e6 m, a value of the config that is not allowed,
/// more than kMaxRasterCells cells. Cost: the cells of the grid.
/// Source: dissertation 3.3.2; Amanatides and Woo 1987. Differs: there Bresenham's line is drawn from the
/// cell of one corner to that of the other, which moves the wall's ends to the middles of their cells and
/// skips cells that it grazes.
Result<OccupancyGrid> rasterize(const FloorPlan& plan, const RasterConfig& config = {});

constexpr std::int64_t kMaxRasterCells = 100'000'000;

}  // namespace beaconless
