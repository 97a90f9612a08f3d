// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// What a building is known by: its walls, or a grid of cells.
using Map = std::variant<FloorPlan, OccupancyGrid>;

}  // namespace beaconless
