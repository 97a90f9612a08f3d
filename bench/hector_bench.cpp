// SPDX-License-Identifier: Apache-2.0
// The HectorSLAM matcher, scan by scan over whole drives, each from the pose before it: hector_slam's own
// steps (4 + 4 + 6 on three levels), the same without processor-specific code, and with an end at
// convergence.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "beaconless/io/map_io.hpp"
#include "beaconless/map/rasterize.hpp"
#include "beaconless/match/hector.hpp"

#include "bench/drives.hpp"
#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::Drive;

struct Case {
  std::shared_ptr<const Drive> drive;
  std::shared_ptr<const OccupancyPyramid> map;
  HectorConfig config;
  VectorLoop loop = fastest_vector_loop();
};

void match(benchmark::State& state, const Case& run) {
  std::vector<std::vector<Eigen::Vector2d>> scans;
  scans.reserve(run.drive->scans.size());
  for (std::size_t i = 0; i < run.drive->scans.size(); ++i)
    scans.push_back(bench::points_of(run.drive->scan(i)));
  HectorScratch scratch;
  scratch.loop = run.loop;
  bench::Latencies latencies;
  double squares_m2 = 0.0;
  double steps = 0.0;
  double count = 0.0;
  for (auto _ : state) {
    Pose2 pose = run.drive->map_from_laser(0);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const MatchResult found =
          latencies.measure([&] { return match_hector(scans[i], *run.map, pose, run.config, scratch); });
      pose = found.map_from_laser;
      squares_m2 += std::pow(distance_m(pose, run.drive->map_from_laser(i)), 2);
      steps += found.iterations;
      count += 1.0;
    }
  }
  latencies.report(state);
  state.counters["rmse_mm"] = 1e3 * std::sqrt(squares_m2 / count);
  state.counters["steps"] = steps / count;
}

void add(const std::shared_ptr<const Drive>& drive, const std::string& on, OccupancyPyramid map) {
  const Case all{drive, std::make_shared<const OccupancyPyramid>(std::move(map))};
  Case portable = all;
  portable.loop = VectorLoop::portable;
  Case early = all;
  early.config.stops_early = true;
  const struct {
    const char* name;
    const Case& run;
  } cases[] = {{"match/", all}, {"match_portable/", portable}, {"match_stops_early/", early}};
  for (const auto& [name, run] : cases)
    benchmark::RegisterBenchmark((name + drive->name + "/" + on).c_str(), match, run)
        ->Unit(benchmark::kMillisecond);
}

void add_all() {
  for (const char* scenario : {"small-drive", "room-ellipse-people"}) {
    const auto drive = std::make_shared<const Drive>(bench::simulated_drive(scenario));
    add(drive, "plan_5cm", build_pyramid(drive->plan).value());
    add(drive, "drawn_5cm", build_pyramid(rasterize(drive->plan).value()).value());
  }
  const struct {
    const char* name;
    const char* building;
  } recordings[] = {{"sim_rooms/a1_static", "sim_rooms/a_room4x3"},
                    {"sim_rooms/b1_ellipse", "sim_rooms/b_room12x8"}};
  for (const auto& [name, building] : recordings) {
    auto recorded = bench::recorded_drive(name, std::string(building) + ".plan.yaml");
    const std::string coarse = bench::recorded_file(std::string(building) + "_r050.yaml");
    const std::string fine = bench::recorded_file(std::string(building) + "_r025.yaml");
    if (!recorded || coarse.empty() || fine.empty()) {
      std::cerr << "hector_bench: no " << name << " below BEACONLESS_DATA: left out\n";
      continue;
    }
    const auto drive = std::make_shared<const Drive>(std::move(*recorded));
    add(drive, "plan_5cm", build_pyramid(drive->plan).value());
    add(drive, "grid_5cm", build_pyramid(std::get<OccupancyGrid>(io::read_map(coarse).value())).value());
    add(drive, "grid_2.5cm", build_pyramid(std::get<OccupancyGrid>(io::read_map(fine).value())).value());
  }
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
