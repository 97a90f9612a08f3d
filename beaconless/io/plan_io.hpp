// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/yaml_tree.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless::io {

/// Makes a floor plan of the YAML `walls: [[[x, y], [x, y], …], …]`: polylines in metres, in the map frame.
///
/// Errors (with path:line): a key other than `walls` (the nearest known one is named), no walls, a polyline
/// of fewer than two points, a point that is not two finite numbers within ±1e7 m.
Result<FloorPlan> plan_from_yaml(const std::string& path, const YamlNode& yaml);

/// Reads a floor plan; `read_map` takes either kind of map.
Result<FloorPlan> read_plan(const std::string& path);

/// Writes a floor plan, one polyline a line; reading it gives the same bits.
Result<Done> write_plan(const std::string& path, const FloorPlan& plan);

}  // namespace beaconless::io
