// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "console.hpp"

/// The verbs of the program. Each `add_…` puts one verb with its options into the program; when the user's
/// words choose it, it runs and leaves its exit code in `exit_code`.
namespace beaconless::cli {

void add_simulate(CLI::App& app, Console& console, int& exit_code);
void add_localize(CLI::App& app, Console& console, int& exit_code);
void add_evaluate(CLI::App& app, Console& console, int& exit_code);
void add_map(CLI::App& app, Console& console, int& exit_code);
void add_poses(CLI::App& app, Console& console, int& exit_code);
void add_convert(CLI::App& app, Console& console, int& exit_code);
void add_info(CLI::App& app, Console& console, int& exit_code);
void add_doctor(CLI::App& app, Console& console, int& exit_code);
void add_features(CLI::App& app, Console& console, int& exit_code);
void add_params(CLI::App& app, Console& console, int& exit_code);
void add_methods(CLI::App& app, Console& console, int& exit_code);
void add_demo(CLI::App& app, Console& console, int& exit_code);
void add_reproduce(CLI::App& app, Console& console, int& exit_code);

}  // namespace beaconless::cli
