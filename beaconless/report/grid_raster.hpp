// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/report/png.hpp"

namespace beaconless::report {

/// An occupancy grid as an image: walls dark, free space clear, what is unknown grey and half clear.
///
/// Only shades of black and transparency, so that a dark page can invert it.
struct GridRaster {
  IndexedImage image;
  Pose2 map_from_image;  ///< of the image's lower left corner: x along its rows, y up its columns
  double pixel_m = 0.0;
};

/// Takes the part of the grid that holds known cells; blocks of cells become one pixel where there are more
/// than `max_pixels`. A block with an obstacle in it is as occupied as its most occupied cell, so that thin
/// walls stay; any other has the mean of its known cells, so that free space stays clear.
///
/// Out: an empty image where no cell is known, or the grid's sizes contradict each other. Cost: O(cells).
GridRaster raster_of(const OccupancyGrid& grid, std::size_t max_pixels = 2'000'000);

}  // namespace beaconless::report
