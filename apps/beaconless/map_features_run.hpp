// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands.hpp"

namespace beaconless::cli {

/// Adds `features` to the verbs of `beaconless map`.
void add_map_features(CLI::App& map, Console& console, int& exit_code);

}  // namespace beaconless::cli
