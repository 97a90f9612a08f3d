// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "localize_run.hpp"
#include "simulate_run.hpp"

namespace beaconless::cli {
namespace {

struct DemoWords {
  std::string scenario = "small-drive";
  std::string out = "demo";
};

int demo(const Console& console, const DemoWords& words) {
  console.note("1. A simulated robot with a UTM-30LX drives: scenario " + words.scenario);
  const auto files = simulate_run(console, words.scenario, std::nullopt, words.out);
  if (!files) return console.fail(files.error());
  console.note("2. It is localized by its laser alone, and compared with the truth");
  LocalizeWords localize;
  localize.recording = files->recording;
  localize.map = files->plan;
  localize.base_from_laser = files->base_from_laser;
  localize.start_from = files->truth;
  localize.reference = files->truth;
  localize.out = words.out;
  localize.title = "Demo: " + words.scenario;
  localize.command_line = "beaconless demo --scenario " + words.scenario + " --out " + words.out;
  const int exit_code = localize_run(console, localize);
  if (exit_code == exit_good)
    console.say("\nopen this in a browser:  " +
                std::filesystem::absolute(words.out + "/report.html").lexically_normal().string());
  return exit_code;
}

}  // namespace

void add_demo(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("demo", "Simulate, localize and report, in one go");
  auto words = std::make_shared<DemoWords>();
  command->add_option("--scenario", words->scenario, "Name of a scenario, or a scenario file")
      ->capture_default_str();
  command->add_option("--out", words->out, "Folder for everything")->capture_default_str();
  command->callback([&console, &exit_code, words] { exit_code = demo(console, *words); });
}

}  // namespace beaconless::cli
