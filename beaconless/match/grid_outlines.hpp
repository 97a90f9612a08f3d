// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// How far the middles of cells may stray from a wall that is straight.
struct GridOutlinesConfig {
  double straight_cells = 1.5;  ///< a straight wall's cells stray by 1 from the line through two of them
  int thin_cells = 0;  ///< walls of no more cells are lines through the middle of them; 0: all have two sides
  double straight_least_m = 0.04;  ///< … and by the noise of the laser that drew a finer grid
};

void describe(Fields& fields, GridOutlinesConfig& config);

/// The walls of a grid as a floor plan: closed outlines through the middles of the outermost cells of
/// whatever is occupied, straight from corner to corner.
///
/// A wall one cell thick comes out as a line that goes there and back. Cells that touch at a corner hang
/// together, so that nothing is seen through oblique walls; a cell by itself is a square on edge as wide as
/// itself. Out: map frame. Cost: linear in the cells, and in those of outlines times the log of their number.
///
/// Source: the outlines are followed along the borders of cells (Kovalevsky, "Finite topology as applied to
/// image analysis", 1989), cut by Ramer 1972 and Douglas and Peucker 1973. Each piece is then replaced by the
/// principal axis of its cells and corners by where those cross, so that the error of a corner is a part of a
/// cell; what is left is that all cells of a wall along the grid are off by the same. Middles rather than
/// faces, because a beam that draws a cell ends anywhere in it.
FloorPlan outlines_of(const OccupancyGrid& grid, const GridOutlinesConfig& config = {});

}  // namespace beaconless
