// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "beaconless/localize/localizer.hpp"

#include "bench/trust/scan_record.hpp"
#include "bench/trust/trial.hpp"

namespace beaconless::trust {

/// The localizer that a trial is run with.
std::unique_ptr<Localizer> localizer_for(const Trial& trial, const std::string& method);

/// Runs a trial through a localizer of its own, scan by scan.
std::vector<ScanRecord> follow(const Trial& trial, const std::string& method);

}  // namespace beaconless::trust
