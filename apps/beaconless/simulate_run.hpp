// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "console.hpp"

namespace beaconless::cli {

/// The files that a simulation writes.
struct SimulatedFiles {
  std::string recording;
  std::string truth;
  std::string plan;
  std::string base_from_laser;  ///< x,y,deg
};

/// Simulates a scenario (a shipped one by name, or a file) into a folder.
Result<SimulatedFiles> simulate_run(const Console& console, const std::string& name, std::optional<int> seed,
                                    const std::string& out);

}  // namespace beaconless::cli
