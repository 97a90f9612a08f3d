// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/map/occupancy_level.hpp"

namespace beaconless {

/// How a pyramid is made.
struct PyramidConfig {
  int levels = 3;              ///< each half as fine as the one before
  double resolution_m = 0.05;  ///< of the finest level, where the map is a floor plan; a grid has its own
};

void describe(Fields& fields, PyramidConfig& config);

/// The same obstacles at several resolutions, finest first; the coarse ones are felt from further away.
///
/// A map that grows is a pyramid whose levels are changed: see OccupancyLevel::cover() and set().
/// Source: Kohlbrecher et al., SSRR 2011; dissertation 2.4.2.
struct OccupancyPyramid {
  std::vector<OccupancyLevel> levels;
  double wall_sigma_m = 0.0;  ///< by how much cells may have moved walls that are seen at once, all alike
};

/// How a wall looks in a level: 1 in cells whose middle is within half a cell of it, from there falling by 1
/// a cell, to 0 at 1.5 cells.
///
/// A tent without its top. With a top, M is below 1 between the middles of cells, 1 - M is left there however
/// well a beam fits, and Gauss-Newton steps too far; half a cell is the least at which every row of cells
/// that a wall passes has a 1. Drawn cells (0 or 1) have that too, but forget where in its cell the wall was.
double wall_value(double distance_m, double resolution_m);

/// The pyramid of a floor plan, each level drawn for itself from the walls by wall_value(), its rows at
/// oblique_heading_rad().
///
/// Errors: no walls, a corner that is not finite or beyond 1e6 m, a value of the config that is not allowed,
/// too many cells. Cost: the cells. Differs: dissertation 3.3.2 draws lines into cells along the walls; what
/// that costs in accuracy shows build_pyramid(rasterize(plan)).
Result<OccupancyPyramid> build_pyramid(const FloorPlan& plan, const PyramidConfig& config = {});

/// The pyramid of a grid map. The finest level has the grid's own cells, with OccupancyLevel::value_of() of
/// their percent. Coarse cells have wall_value() of the distance to the middles of the grid's cells, times
/// their value; they are known if one of the cells below them is.
///
/// Errors: a grid without cells, whose cells are not as many as its size says, or whose resolution or pose is
/// not finite and positive; too many cells. Cost: the cells.
/// Differs: in hector_slam a coarse level is a map of its own, made from scans; of a finished grid there are
/// none.
Result<OccupancyPyramid> build_pyramid(const OccupancyGrid& grid, const PyramidConfig& config = {});

}  // namespace beaconless
