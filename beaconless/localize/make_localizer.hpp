// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless {

/// A method's name and what it does in one sentence.
struct Method {
  std::string name;
  std::string sentence;
};

/// All methods that make_localizer knows.
std::span<const Method> methods();

/// Builds the localizer that `config.method` names, on a map.
///
/// Errors: an unknown method (with the nearest known one), a field outside its range, a map without walls.
/// Cost: builds the index of the map; seconds for maps of many million cells.
Result<std::unique_ptr<Localizer>> make_localizer(const LocalizerConfig& config, const Map& map);

}  // namespace beaconless
