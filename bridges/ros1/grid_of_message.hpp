// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/map/map.hpp"

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// The grid of a message. Cells outside -1 … 100 are unknown; the origin's heading is honoured.
///
/// Errors: no cells, more than 2^28, another number of them than width times height, a cell size or origin
/// that is none.
Result<OccupancyGrid> grid_of_message(const GridMessage& message);

/// A map as a message: a grid as it is, a floor plan drawn into cells. Errors: those of rasterize().
Result<GridMessage> message_of_map(const Map& map, const std::string& frame);

}  // namespace beaconless::ros1
