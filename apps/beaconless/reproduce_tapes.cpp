// SPDX-License-Identifier: Apache-2.0
#include "reproduce_tapes.hpp"

#include <algorithm>

#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/sim/tape_measured.hpp"

#include "reproduce_published.hpp"

namespace beaconless::cli {
namespace {

constexpr std::size_t kScans = 8;

bool is_published(std::string_view scenario, std::string_view method) {
  return std::ranges::any_of(kPublishedTables, [&](const PublishedTable& table) {
    return table.scenario == scenario &&
           std::ranges::any_of(table.rows, [&](const PublishedRow& row) { return row.method == method; });
  });
}

struct MeanError {
  double position_m = 0.0;
  double heading_deg = 0.0;
};

/// The mean errors of a few scans on one map.
MeanError mean_error(const Scene& scene, Localizer& localizer) {
  const std::size_t count = std::min(kScans, scene.run.events.size());
  MeanError mean;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k * scene.run.events.size() / count;
    const Pose2& truth = scene.run.truth[i].pose;
    localizer.start_at(truth);
    const Pose2 found = localizer.update(scene.run.events[i]).map_from_base;
    mean.position_m += distance_m(found, truth) / static_cast<double>(count);
    mean.heading_deg += degrees(heading_difference_rad(found, truth)) / static_cast<double>(count);
  }
  return mean;
}

/// A method in the scenes of a plan that the dissertation has it in, on one tape after the other.
void run_method(std::span<const Scene> scenes, std::span<const std::size_t> places, const std::string& method,
                int first_seed, int tapes, Progress& progress, std::vector<TapeSpread>& spreads) {
  const std::size_t begin = spreads.size();
  for (const std::size_t s : places) spreads.push_back({.scenario = scenes[s].name(), .method = method});
  for (int seed = first_seed; seed < first_seed + tapes; ++seed) {
    const sim::Scenario& scenario = scenes[places.front()].scenario;
    progress.step();
    auto localizer = make_localizer({.method = method, .base_from_laser = scenario.base_from_laser},
                                    sim::tape_measured(scenario.plan, {.seed = seed}));
    if (!localizer) continue;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const MeanError mean = mean_error(scenes[places[i]], **localizer);
      spreads[begin + i].mean_m.push_back(mean.position_m);
      spreads[begin + i].mean_deg.push_back(mean.heading_deg);
    }
  }
}

}  // namespace

double TapeSpread::share_up_to(std::span<const double> ascending, double value) {
  if (ascending.empty()) return 0.0;
  const auto count = std::ranges::upper_bound(ascending, value) - ascending.begin();
  return static_cast<double>(count) / static_cast<double>(ascending.size());
}

double TapeSpread::quantile(std::span<const double> ascending, double share) {
  return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

std::vector<TapeSpread> run_tapes(const Console& console, std::span<const Scene> scenes,
                                  std::span<const std::string> methods, int first_seed, int tapes) {
  std::vector<TapeSpread> spreads;
  Progress progress(console, "other tapes", 0);
  for (const auto& group : by_plan(scenes))
    for (const std::string& method : methods) {
      std::vector<std::size_t> places;
      for (const std::size_t s : group)
        if (is_published(scenes[s].name(), method)) places.push_back(s);
      if (!places.empty()) run_method(scenes, places, method, first_seed, tapes, progress, spreads);
    }
  for (TapeSpread& spread : spreads) {
    std::ranges::sort(spread.mean_m);
    std::ranges::sort(spread.mean_deg);
  }
  std::erase_if(spreads, [](const TapeSpread& spread) { return spread.mean_m.empty(); });
  return spreads;
}

const TapeSpread* find(std::span<const TapeSpread> spreads, std::string_view scenario,
                       std::string_view method) {
  const auto found = std::ranges::find_if(spreads, [&](const TapeSpread& spread) {
    return spread.scenario == scenario && spread.method == method;
  });
  return found == spreads.end() ? nullptr : &*found;
}

}  // namespace beaconless::cli
