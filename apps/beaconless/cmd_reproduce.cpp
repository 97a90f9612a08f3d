// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "commands.hpp"
#include "reproduce_run.hpp"

namespace beaconless::cli {

void add_reproduce(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("reproduce", "Run the dissertation's experiments and report on them");
  auto words = std::make_shared<ReproduceWords>();
  command->add_option("--out", words->out, "Folder for everything")->capture_default_str();
  command->add_option("--methods", words->methods, "Only these, separated by commas (see beaconless methods)")
      ->delimiter(',');
  command->add_option("--tape-seed", words->tape_seed, "Which errors the tape makes")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  command->add_option("--tapes", words->tapes, "How many other tapes to compare it with")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command->add_flag("--quick", words->is_quick, "Half a second of each scenario, to see whether all runs");
  command->footer("Example:  beaconless reproduce --out out/reproduce");
  command->callback([&console, &exit_code, words] { exit_code = reproduce_run(console, *words); });
}

}  // namespace beaconless::cli
