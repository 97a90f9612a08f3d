// SPDX-License-Identifier: Apache-2.0
#include "simulate_run.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "beaconless/core/suggest.hpp"
#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/plan_io.hpp"
#include "beaconless/io/scenario_io.hpp"
#include "beaconless/io/tum.hpp"

#include "words.hpp"

namespace beaconless::cli {
namespace {

namespace fs = std::filesystem;

Result<sim::Scenario> find_scenario(const std::string& name) {
  if (name.ends_with(".yaml") || name.ends_with(".yml")) return io::read_scenario(name);
  if (const auto path = shipped_file("scenarios/" + name + ".yaml")) return io::read_scenario(*path);
  std::string known;
  const auto names = io::scenario_names(shipped_file("scenarios").value_or(""));
  for (const std::string& shipped : names) known += (known.empty() ? "" : ", ") + shipped;
  const std::string near = nearest_word(name, names);
  return Error{name, "there is no such scenario",
               (near.empty() ? "" : "did you mean \"" + near + "\"? ") + ("there are: " + known)};
}

}  // namespace

Result<SimulatedFiles> simulate_run(const Console& console, const std::string& name, std::optional<int> seed,
                                    const std::string& out) {
  auto scenario = find_scenario(name);
  if (!scenario) return scenario.error();
  sim::Scenario chosen = *std::move(scenario);
  if (seed) chosen.seed = *seed;

  std::error_code failed;
  fs::create_directories(out, failed);
  if (failed) return Error{out, failed.message(), "choose another --out"};
  const auto path_of = [&](const char* file) { return (fs::path(out) / file).string(); };
  SimulatedFiles files{path_of("recording.log.gz"), path_of("truth.tum"), path_of("plan.yaml"),
                       fmt::format("{},{},{}", chosen.base_from_laser.x_m, chosen.base_from_laser.y_m,
                                   degrees(chosen.base_from_laser.theta_rad))};

  io::CarmenWriter recording(files.recording,
                             "simulated: scenario " + chosen.name + ", seed " + std::to_string(chosen.seed));
  std::vector<StampedPose> truth;
  Progress progress(console, "sweep", chosen.sweep_count());
  const auto simulated = sim::simulate(chosen, [&](const sim::Sample& sample) {
    recording.write(sample.scan);
    truth.push_back({sample.scan.stamp, sample.map_from_base});
    progress.step();
  });
  if (!simulated) return simulated.error();
  if (!recording.close())
    return Error{files.recording, "cannot be written", "is there space, and may you write there?"};
  if (auto written = io::write_tum(files.truth, Trajectory(std::move(truth))); !written)
    return written.error();
  if (auto written = io::write_plan(files.plan, chosen.plan); !written) return written.error();
  return files;
}

}  // namespace beaconless::cli
