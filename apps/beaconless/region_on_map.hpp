// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless::cli {

/// Whether a region to look for the robot in has any part of the map. In: the words that it was told by.
///
/// Errors: it lies wholly outside of the box around the map's walls.
Result<Done> check_on_map(std::string_view words, const SearchRegion& region, const Map& map);

}  // namespace beaconless::cli
