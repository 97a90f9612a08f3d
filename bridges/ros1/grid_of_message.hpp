// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/result.hpp"
#include "beaconless/map/occupancy_grid.hpp"

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// The grid of a message. Cells outside -1 … 100 are unknown; the origin's heading is honoured.
///
/// Errors: no cells, more than 2^28, another number of them than width times height, a cell size or origin
/// that is none.
Result<OccupancyGrid> grid_of_message(const GridMessage& message);

}  // namespace beaconless::ros1
