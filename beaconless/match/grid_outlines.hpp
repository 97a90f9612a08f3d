// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// How far the middles of cells may stray from a wall that is straight.
struct GridOutlinesConfig {
  double straight_cells = 1.5;  ///< a straight wall's cells stray by 1 from the line through two of them
  int thin_cells = 0;  ///< walls no thicker are lines through their middle, there once; 0: all have two sides
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
///
/// With `thin_cells` walls are single pieces, not outlines: what is at least four times as long as thick and
/// no thicker than that lies where its cells leave room for a line (see drawn_line) if they are alike, else
/// along their middles by occupancy. A line goes on past what stands against it, to where its cells end. What
/// shows no cell that a surer wall does not pass through is left out. The plan then says of which cells it
/// was read. Errors: an end may be off by a cell, and where cells of other things fit the line too, so may
/// that.
FloorPlan outlines_of(const OccupancyGrid& grid, const GridOutlinesConfig& config = {});

}  // namespace beaconless
