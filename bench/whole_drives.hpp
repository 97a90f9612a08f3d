// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bench/drives.hpp"

namespace beaconless::bench {

using SharedDrive = std::shared_ptr<const Drive>;

/// The drives that detectors are timed on: a scenario of data/scenarios, and the two recorded rooms where
/// those are; what is left out is said on standard error.
std::vector<SharedDrive> whole_drives(const std::string& scenario = "room-ellipse");

/// A benchmark program: `add` registers what it has. Gives the exit code.
int run_benchmarks(int argc, char** argv, const std::function<void()>& add);

}  // namespace beaconless::bench
