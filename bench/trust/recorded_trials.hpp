// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/trust/trial.hpp"

namespace beaconless::trust {

/// A recording with a map and a reference, read when it is asked for.
struct RecordedTrial {
  std::string name;
  bool can_be_carried = true;  ///< scans follow closely enough to be tracked
  std::function<Trial()> read;
};

/// Those whose files are below BEACONLESS_DATA; what is left out is said on standard error.
std::vector<RecordedTrial> recorded_trials();

}  // namespace beaconless::trust
