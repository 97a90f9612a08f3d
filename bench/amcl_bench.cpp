// SPDX-License-Identifier: Apache-2.0
// update() of amcl with a thousand particles and sixty beams, every scan an update, on drawn grids of 5 cm
// with wheels made up from the truth: how long it takes beside the vector loop, and how far off it is.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "bench/drives.hpp"
#include "bench/latencies.hpp"
#include "bench/vector_pace.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;

constexpr double kWheelShare = 0.05;  // of a way or turn that made-up wheels are off by
constexpr double kWheelTurn_radpm = 0.02;

/// What wheels would have told at each scan.
std::vector<Event> wheels_of(const bench::Drive& drive) {
  Rng rng(1);
  std::vector<Event> readings;
  readings.reserve(drive.scans.size());
  Pose2 odom_from_base;
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    if (i > 0) {
      const Pose2 moved = drive.truth[i - 1].pose.inverse() * drive.truth[i].pose;
      const double way_m = std::hypot(moved.x_m, moved.y_m);
      const double slip = 1.0 + rng.normal(kWheelShare);
      const double turn =
          moved.theta_rad * (1.0 + rng.normal(kWheelShare)) + rng.normal(kWheelTurn_radpm * way_m);
      odom_from_base = odom_from_base * Pose2{slip * moved.x_m, slip * moved.y_m, turn};
    }
    readings.emplace_back(Odometry{drive.scan(i).stamp(), odom_from_base, std::nullopt, ""});
  }
  return readings;
}

struct Run {
  bench::SharedDrive drive;
  std::shared_ptr<const Map> map;
  std::string method = "amcl";
  bool has_wheels = true;
  LaserModel model = LaserModel::likelihood_field_prob;
};

void track(benchmark::State& state, const Run& run) {
  const std::vector<Event> wheels = wheels_of(*run.drive);
  LocalizerConfig config{.method = run.method, .base_from_laser = run.drive->base_from_laser};
  config.amcl.min_particles = config.amcl.max_particles = 1000;
  config.amcl.laser_max_beams = 60;
  config.amcl.update_min_d = config.amcl.update_min_a = 0.0;
  config.amcl.laser_model_type = run.model;
  const auto localizer = make_localizer(config, *run.map).value();
  bench::Latencies latencies;
  double loop_ms = bench::vector_loop_ms();
  double squares_m2 = 0.0;
  double scans = 0.0;
  double ok = 0.0;
  for (auto _ : state) {
    localizer->start_at(run.drive->truth.front().pose);
    for (std::size_t i = 0; i < run.drive->scans.size(); ++i) {
      if (run.has_wheels) localizer->update(wheels[i]);
      const PoseEstimate estimate = latencies.measure([&] { return localizer->update(run.drive->scans[i]); });
      squares_m2 += std::pow(distance_m(estimate.map_from_base, run.drive->truth[i].pose), 2);
      ok += estimate.ok() ? 1.0 : 0.0;
      scans += 1.0;
    }
  }
  loop_ms = std::min(loop_ms, bench::vector_loop_ms());
  latencies.report(state);
  state.counters["loop_ms"] = loop_ms;
  state.counters["us_per_loop_ms"] = state.counters["p50_us"] / loop_ms;
  state.counters["rmse_mm"] = 1e3 * std::sqrt(squares_m2 / scans);
  state.counters["ok_share"] = ok / scans;
}

void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), track, run)->Unit(benchmark::kMillisecond);
}

void add_all() {
  const struct {
    const char* name;
    const char* building;
  } recordings[] = {{"sim_rooms/b1_ellipse", "sim_rooms/b_room12x8"},
                    {"sim_rooms/a1_static", "sim_rooms/a_room4x3"}};
  for (const auto& [name, building] : recordings) {
    auto recorded = bench::recorded_drive(name, std::string(building) + ".plan.yaml");
    const std::string grid = bench::recorded_file(std::string(building) + "_r050.yaml");
    if (!recorded || grid.empty()) {
      std::cerr << "amcl_bench: no " << name << " below BEACONLESS_DATA: left out\n";
      continue;
    }
    const auto drive = std::make_shared<const bench::Drive>(std::move(*recorded));
    const auto drawn = std::make_shared<const Map>(io::read_map(grid).value());
    const auto plan = std::make_shared<const Map>(drive->plan);
    const std::string of = "/" + drive->name;
    add("wheels" + of + "/grid_5cm", {drive, drawn});
    add("wheels" + of + "/plan", {drive, plan});
    add("laser_only" + of + "/grid_5cm", {.drive = drive, .map = drawn, .has_wheels = false});
    add("cubes" + of + "/grid_5cm", {.drive = drive, .map = drawn, .model = LaserModel::likelihood_field});
    add("polished" + of + "/grid_5cm", {.drive = drive, .map = drawn, .method = "amcl+walls"});
    add("polished" + of + "/plan", {.drive = drive, .map = plan, .method = "amcl+walls"});
  }
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
