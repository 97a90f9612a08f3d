// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "console.hpp"

namespace beaconless::cli {

/// The words of `beaconless reproduce`.
struct ReproduceWords {
  std::string out = "reproduce";
  int tape_seed = 1;
  int tapes = 50;
  std::vector<std::string> methods;  ///< none: all
  bool is_quick = false;
};

/// Runs every experiment and writes report.html, summary.md and the CSV files; gives the exit code.
int reproduce_run(const Console& console, const ReproduceWords& words);

}  // namespace beaconless::cli
