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
  bool oblique = true;         ///< of a floor plan: the grid is turned against the walls
};

void describe(Fields& fields, PyramidConfig& config);

/// The same walls at several resolutions, finest first. Coarse levels lead to a pose from further away.
///
/// Source: Kohlbrecher et al., SSRR 2011; dissertation 2.4.2.
struct OccupancyPyramid {
  std::vector<OccupancyLevel> levels;
  double wall_sigma_m =
      0.0;  ///< by how much drawing into cells may have moved the walls that are seen together
};

/// A pyramid of a grid map. Coarse cells are occupied as much as the most occupied of the cells they cover,
/// and known if any of those is.
///
/// M is OccupancyLevel::value_of() of a cell's percent. Errors: an empty grid, a resolution that is not
/// positive, too many cells.
Result<OccupancyPyramid> build_pyramid(const OccupancyGrid& grid, const PyramidConfig& config = {});

/// A pyramid of a floor plan, each level drawn for itself; see rasterize() and oblique_heading_rad().
///
/// Errors: those of rasterize().
Result<OccupancyPyramid> build_pyramid(const FloorPlan& plan, const PyramidConfig& config = {});

}  // namespace beaconless
