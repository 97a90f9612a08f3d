// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer_config.hpp"

#include "bridges/ros1/node_config.hpp"

namespace beaconless::ros1 {

/// All that the parameters of a node say.
struct Settings {
  NodeConfig node;
  LocalizerConfig localizer;
  bool has_initial_pose = false;     ///< told, not the default
  bool has_base_from_laser = false;  ///< told, so that tf is not asked
  std::vector<std::string> remarks;  ///< for the log: names that nobody knows, or that change nothing here
};

/// Reads parameters by name: those of the node, every one of the localizer, and amcl's.
///
/// In: names of trees joined by points, values as text. A name that nobody knows is a remark with the nearest
/// known one. Errors: a value that is not allowed, with the name that was given.
Result<Settings> settings_of(const std::map<std::string, std::string>& parameters);

}  // namespace beaconless::ros1
