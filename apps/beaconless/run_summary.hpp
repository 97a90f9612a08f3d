// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "localize_run.hpp"
#include "run_files.hpp"
#include "tables.hpp"

namespace beaconless::cli {

std::map<std::string, std::size_t> status_counts(const Run& run);

/// Why estimates were not ok, and how many each time.
std::map<std::string, std::size_t> reason_counts(const Run& run);

/// What there is to tell of each jump: "jumped 2.3 m at 12.4 s".
std::vector<std::string> jumps_of(const Run& run);

/// The places that fit at the end of a run that does not know which one it is, for people; empty where it
/// does.
std::vector<std::string> ambiguous_lines(const Run& run);

/// summary.json, see docs/reference/files.md.
nlohmann::json summary_of(const LocalizeWords& words, const Run& run,
                          const std::optional<Judgement>& judgement);

}  // namespace beaconless::cli
