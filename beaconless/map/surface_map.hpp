// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "beaconless/core/result.hpp"
#include "beaconless/map/cell_index.hpp"
#include "beaconless/map/map.hpp"
#include "beaconless/map/wall_index.hpp"

namespace beaconless {

/// The surfaces of a map of either kind, ready to be asked for the nearest one.
using SurfaceMap = std::variant<WallIndex, CellIndex>;

/// Builds the index of a map's surfaces. Errors: a map without any. Cost: that of WallIndex or CellIndex;
/// seconds for maps of many million cells.
Result<SurfaceMap> build_surface_map(const Map& map, double reach_m);

/// The box around a map's surfaces, along the axes of the map frame.
FloorPlan::Bounds bounds_of(const SurfaceMap& map);

}  // namespace beaconless
