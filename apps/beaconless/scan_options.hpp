// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "words.hpp"

/// The options of the verbs that read scans, said alike by all of them.
namespace beaconless::cli {

void add_scan_range_options(CLI::App& verb, ScanWords& words);  ///< --min-range, --max-range
void add_scan_time_options(CLI::App& verb, ScanWords& words);   ///< --stamp-is, --sweep-time

}  // namespace beaconless::cli
