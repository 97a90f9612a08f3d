// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/recorded_trials.hpp"

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/map_io.hpp"

#include "bench/drives.hpp"
#include "bench/trust/recorded_scans.hpp"

namespace beaconless::trust {
namespace {

constexpr std::size_t kFolds = 10;

std::string file(const std::string& name) { return name.empty() ? "" : bench::recorded_file(name); }

/// How a recording is told apart from others, and how sure its reference is.
struct Recipe {
  std::string name;
  RecordedSource source;  ///< names below the data folder
  std::string map;        ///< likewise; empty: the grid of every other scan
  double reference_m = 0.0;
  double reference_rad = 0.0;
  std::optional<double> sigma_m;
  bool hears_odometry = false;  ///< where it is the wheels' own
  bool moves = true;
};

RecordedSource found(RecordedSource source) {
  source.log = file(source.log);
  source.truth = file(source.truth);
  return source;
}

Trial empty_trial(const Recipe& recipe) {
  return {.kind = "recording",
          .family = recipe.name,
          .base_from_laser = recipe.source.base_from_laser,
          .sigma_m = recipe.sigma_m,
          .reference_m = recipe.reference_m,
          .reference_rad = recipe.reference_rad};
}

void put_scans(Trial& trial, RecordedScans scans, bool hears_odometry) {
  if (!hears_odometry)
    std::erase_if(scans.events, [](const Event& event) { return std::holds_alternative<Odometry>(event); });
  trial.events = std::move(scans.events);
  trial.truth = std::move(scans.truth);
}

/// The robot is followed from the reference on.
Trial followed(const Recipe& recipe) {
  Trial trial = empty_trial(recipe);
  RecordedScans scans = read_scans(found(recipe.source));
  if (recipe.map.empty()) {
    const auto is_even = [](std::size_t i) { return i % 2 == 0; };
    trial.map = std::make_shared<const Map>(grid_of(chosen(scans, is_even), recipe.source.base_from_laser));
    scans = chosen(scans, [&](std::size_t i) { return !is_even(i); });
  } else {
    trial.map = std::make_shared<const Map>(io::read_map(file(recipe.map)).value());
    if (const auto* plan = std::get_if<FloorPlan>(trial.map.get())) trial.walls = *plan;
  }
  put_scans(trial, std::move(scans), recipe.hears_odometry);
  trial.starts.push_back({0, trial.truth.front()});
  return trial;
}

/// Every tenth scan alone, 0.3 m and 10 deg off, on a grid of the other nine tenths: of logs that keep one
/// scan a metre.
Trial alone(const Recipe& recipe, std::size_t fold) {
  Trial trial = empty_trial(recipe);
  const RecordedScans scans = read_scans(found(recipe.source));
  const auto is_in_fold = [&](std::size_t i) { return i % kFolds == fold; };
  trial.map = std::make_shared<const Map>(
      grid_of(chosen(scans, [&](std::size_t i) { return !is_in_fold(i); }), recipe.source.base_from_laser));
  put_scans(trial, chosen(scans, is_in_fold), false);
  Rng rng(fold + 1);
  for (std::size_t i = 0; i < trial.truth.size(); ++i) {
    const double way = rng.uniform(-kPi, kPi);
    const double turn = rng.uniform() < 0.5 ? -radians(10.0) : radians(10.0);
    trial.starts.push_back({i, stepped(trial.truth[i], {0.3 * std::cos(way), 0.3 * std::sin(way), turn})});
  }
  return trial;
}

std::vector<Recipe> followed_recipes() {
  const std::string bag = "jarvis/jarvis_circular_path_fast.bag";
  const std::string pose = "jarvis/jarvis_circular_gt_plan_frame.tum";
  const Pose2 high{0.194, 0.0, 0.0};
  const Pose2 low{0.895, 0.0, 0.0};
  const Pose2 wean{0.25, 0.0, 0.0};
  const std::string room = "sim_rooms/b_room12x8.plan.yaml";
  return {
      {"a1_static",
       {"sim_rooms/a1_static.carmen.log.gz", "", "sim_rooms/a1_static.truth.tum"},
       "sim_rooms/a_room4x3.plan.yaml",
       0.0,
       0.0,
       std::nullopt,
       false,
       false},
      {"b1_ellipse", {"sim_rooms/b1_ellipse.carmen.log.gz", "", "sim_rooms/b1_ellipse.truth.tum"}, room},
      {"jarvis_nav350",
       {bag, "/driver_laser_navigation/laser_scan", pose, StampIs::last_beam, high},
       "jarvis/maps/i-108_10mm.yaml",
       0.02,
       0.002},
      {"jarvis_s3000",
       {bag, "/driver_laser_security/laser_scan", pose, StampIs::last_beam, low},
       "",
       0.02,
       0.002},
      {"fr079", {"fr079/freiburg-079-corrected.log.gz"}, "", 0.05, radians(1.0), 0.02},
      {"wean_2",
       {"wean_hall/robotdata2.carmen.log.gz", "", "wean_hall/robotdata2_derived_ref.tum", StampIs::first_beam,
        wean, true},
       "wean_hall/wean.yaml",
       0.10,
       radians(1.0),
       0.02,
       true},
      {"wean_4",
       {"wean_hall/robotdata4.carmen.log.gz", "", "wean_hall/robotdata4_derived_ref.tum", StampIs::first_beam,
        wean, true},
       "wean_hall/wean.yaml",
       0.10,
       radians(1.0),
       0.02,
       true},
  };
}

std::vector<Recipe> alone_recipes() {
  return {{"mit_csail", {"mit_csail/csail-corrected.log.gz"}, "", 0.05, radians(1.5), 0.02},
          {"seattle", {"radish/seattle-corrected.log.gz"}, "", 0.05, radians(1.0), 0.02}};
}

bool is_here(const Recipe& recipe) {
  for (const std::string& name : {recipe.source.log, recipe.source.truth, recipe.map})
    if (!name.empty() && file(name).empty()) {
      std::cerr << "no " << name << " below BEACONLESS_DATA: left out\n";
      return false;
    }
  return true;
}

}  // namespace

std::vector<RecordedTrial> recorded_trials() {
  std::vector<RecordedTrial> trials;
  for (const Recipe& recipe : followed_recipes())
    if (is_here(recipe)) trials.push_back({recipe.name, recipe.moves, [recipe] { return followed(recipe); }});
  for (const Recipe& recipe : alone_recipes())
    for (std::size_t fold = 0; fold < kFolds && is_here(recipe); ++fold)
      trials.push_back({recipe.name, false, [recipe, fold] { return alone(recipe, fold); }});
  return trials;
}

}  // namespace beaconless::trust
