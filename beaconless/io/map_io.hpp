// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless::io {

/// Reads a map of either kind; the YAML's keys decide: `walls:` is a floor plan, `image:` a map_server grid.
///
/// Errors name path, key, value and what is allowed. Source: wiki.ros.org/map_server for grids.
Result<Map> read_map(const std::string& path);

}  // namespace beaconless::io
