// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// The occupied cells along each border between what is occupied and what is not, in order and with the
/// occupied to the left; a cell that the border leaves and comes back to is there twice.
///
/// Cells that touch at a corner hang together. A loop is closed: after its last cell comes its first. A grid
/// that holds fewer or more cells than it says has none. Cost: linear in the cells.
std::vector<std::vector<Cell>> find_cell_loops(const OccupancyGrid& grid);

}  // namespace beaconless
