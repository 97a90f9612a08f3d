// SPDX-License-Identifier: Apache-2.0
#include "reproduce_scenes.hpp"

#include <algorithm>

#include "beaconless/io/scenario_io.hpp"
#include "beaconless/map/rasterize.hpp"
#include "beaconless/sim/tape_measured.hpp"

#include "words.hpp"

namespace beaconless::cli {
namespace {

constexpr std::array<std::string_view, 7> kScenarios{
    "small-static", "small-rotation",      "room-position-1",          "room-position-2",
    "room-ellipse", "room-ellipse-people", "room-ellipse-three-people"};
constexpr double kQuickDuration_s = 0.5;

Result<Scene> simulate_scene(const std::string& name, int tape_seed, bool is_quick) {
  const auto path = shipped_file("scenarios/" + name + ".yaml");
  if (!path)
    return Error{"scenarios/" + name + ".yaml", "is not there", "set BEACONLESS_SHARE to the folder data/"};
  auto read = io::read_scenario(*path);
  if (!read) return read.error();
  sim::Scenario scenario = *std::move(read);
  if (is_quick) scenario.duration_s = kQuickDuration_s;
  auto run = sim::simulate(scenario);
  if (!run) return run.error();
  auto grid =
      rasterize(scenario.plan, {.phase_x_cells = kGridPhase_cells, .phase_y_cells = kGridPhase_cells});
  if (!grid) return grid.error();
  const FloorPlan plan = scenario.plan;
  return Scene{std::move(scenario),
               *std::move(run),
               {plan, sim::tape_measured(plan, {.seed = tape_seed}), *std::move(grid)}};
}

}  // namespace

std::string_view words(MapKind kind) {
  return kind == MapKind::exact ? "exact plan" : kind == MapKind::tape ? "tape-measured plan" : "5 cm grid";
}

std::string_view name_of(MapKind kind) {
  return kind == MapKind::exact ? "exact" : kind == MapKind::tape ? "tape" : "grid";
}

std::span<const std::string_view> reproduced_scenarios() { return kScenarios; }

Result<std::vector<Scene>> simulate_scenes(const Console& console, int tape_seed, bool is_quick) {
  std::vector<Scene> scenes;
  scenes.reserve(kScenarios.size());
  Progress progress(console, "scenarios simulated", kScenarios.size());
  for (const std::string_view name : kScenarios) {
    auto scene = simulate_scene(std::string(name), tape_seed, is_quick);
    if (!scene) return scene.error();
    scenes.push_back(*std::move(scene));
    progress.step();
  }
  return scenes;
}

std::vector<std::vector<std::size_t>> by_plan(std::span<const Scene> scenes) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const auto same = std::ranges::find_if(groups, [&](const auto& group) {
      return scenes[group.front()].scenario.plan == scenes[s].scenario.plan;
    });
    if (same == groups.end())
      groups.push_back({s});
    else
      same->push_back(s);
  }
  return groups;
}

}  // namespace beaconless::cli
