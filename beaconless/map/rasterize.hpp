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
  double heading_rad = 0.0;  ///< of the grid's rows in the map; see oblique_heading_rad()
  double margin_m = 0.5;     ///< free cells around the outermost walls
  double phase_x_cells =
      0.5;  ///< where in its cell the map's origin lies; 0.5: in the middle, so that walls …
  double phase_y_cells = 0.5;  ///< … at a whole number of cells run through the middles of theirs
};

void describe(Fields& fields, RasterConfig& config);

/// Draws a floor plan into cells: those that a wall crosses are occupied, all others free.
///
/// Every cell that a wall passes through is drawn (exact traversal), each wall one or two cells thick. A
/// drawn wall is off by up to half a cell where it runs along the rows, and all its cells by the same amount;
/// where it runs oblique to them the offsets change from cell to cell and average out. Errors: no walls, a
/// corner that is not finite or beyond 1e6 m, a value of the config that is not allowed, more than
/// kMaxRasterCells cells. Cost: the cells of the grid. Source: Amanatides and Woo 1987. Differs:
/// dissertation 3.3.2 draws with Bresenham's line between the cells of the corners, which moves a wall's ends
/// to the middles of their cells and skips cells it crosses.
Result<OccupancyGrid> rasterize(const FloorPlan& plan, const RasterConfig& config = {});

constexpr std::int64_t kMaxRasterCells = 100'000'000;

/// A heading for a grid to which no wall is nearly parallel, in [0, pi/2): the one whose rows and columns are
/// furthest from the walls' directions, long walls first. 0 for a plan without walls.
///
/// Cost: walls x 180.
double oblique_heading_rad(const FloorPlan& plan);

}  // namespace beaconless
