// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/sim/scenario.hpp"

namespace beaconless::io {

/// Reads a scenario; its name is the file's, without directory and ending.
///
/// The YAML has `plan:` (a floor plan file, found from the scenario's own directory) and `path:` (`kind:
/// standing | turning | ellipse | waypoints` and the fields of sim/path.hpp, `points:` for waypoints), and
/// may have `description:`, `duration_s:`, `seed:`, `base_from_laser: [x_m, y_m, theta_deg]`, `lidar:`
/// (sim/lidar.hpp) and `people:` (a list of sim::Person). What it leaves out keeps the default. Errors (with
/// path and line): those of YAML and of the plan, an unknown key (the nearest known one is named), a value
/// that is not allowed, and those of sim::check.
Result<sim::Scenario> read_scenario(const std::string& path);

/// The names of the scenarios in a directory, sorted: its files that end in .yaml. None for no such
/// directory.
std::vector<std::string> scenario_names(const std::string& directory);

}  // namespace beaconless::io
