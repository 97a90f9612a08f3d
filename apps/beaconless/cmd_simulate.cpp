// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <fmt/format.h>

#include "beaconless/io/scenario_io.hpp"

#include "commands.hpp"
#include "simulate_run.hpp"
#include "words.hpp"

namespace beaconless::cli {
namespace {

struct SimulateWords {
  std::string scenario;
  std::string out;
  std::optional<int> seed;
};

int list_scenarios(const Console& console) {
  const std::string folder = shipped_file("scenarios").value_or("");
  nlohmann::json list = nlohmann::json::array();
  for (const std::string& name : io::scenario_names(folder)) {
    const auto scenario = io::read_scenario(fmt::format("{}/{}.yaml", folder, name));
    const std::string description = scenario ? scenario->description : to_string(scenario.error());
    console.say(fmt::format("{:<24}{}", name, description));
    list.push_back({{"name", name}, {"description", description}});
  }
  console.result({{"scenarios", list}});
  return list.empty() ? exit_data : exit_good;
}

int simulate(const Console& console, const SimulateWords& words) {
  if (words.scenario.empty()) return list_scenarios(console);
  if (words.out.empty())
    return console.fail({"--out", "is needed", "name a folder for the recording"}, exit_usage);
  const auto files = simulate_run(console, words.scenario, words.seed, words.out);
  if (!files) return console.fail(files.error());
  console.say("written:");
  for (const std::string& path : {files->recording, files->truth, files->plan}) console.say("  " + path);
  console.say(
      fmt::format("localize it:  beaconless localize {} --map {} --base-from-laser {} --start-from {} "
                  "--reference {} --out run",
                  files->recording, files->plan, files->base_from_laser, files->truth, files->truth));
  console.result({{"recording", files->recording},
                  {"truth", files->truth},
                  {"plan", files->plan},
                  {"base_from_laser", files->base_from_laser}});
  return exit_good;
}

}  // namespace

void add_simulate(CLI::App& app, Console& console, int& exit_code) {
  auto* command =
      app.add_subcommand("simulate", "Drive a simulated robot through a room; without a scenario, list them");
  auto words = std::make_shared<SimulateWords>();
  command->add_option("scenario", words->scenario, "Name of a scenario, or a scenario file");
  command->add_option("--out", words->out, "Folder for recording, truth and plan");
  command->add_option("--seed", words->seed, "Another seed than the scenario's");
  command->footer("Example:  beaconless simulate room-ellipse --out sim/");
  command->callback([&console, &exit_code, words] { exit_code = simulate(console, *words); });
}

}  // namespace beaconless::cli
