// SPDX-License-Identifier: Apache-2.0
// How long FLIRT takes for one scan, with the defaults and with the parameters of flirtlib's tools.
#include <iostream>
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/features/flirt.hpp"

#include "bench/drives.hpp"
#include "bench/latencies.hpp"

namespace {

using namespace beaconless;
using bench::Drive;

void detect(benchmark::State& state, const std::shared_ptr<const Drive>& drive, const FlirtConfig& config) {
  bench::Latencies latencies;
  FlirtScratch scratch;
  std::vector<Keypoint> keypoints;
  std::size_t scans = 0;
  std::size_t found = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < drive->scans.size(); ++i) {
      found += latencies.measure([&] {
        detect_flirt(drive->scan(i), config, scratch, keypoints);
        return keypoints.size();
      });
      ++scans;
    }
  }
  latencies.report(state);
  state.counters["per_scan"] = static_cast<double>(found) / static_cast<double>(scans);
}

void add(const std::shared_ptr<const Drive>& drive) {
  const struct {
    const char* name;
    FlirtKind kind;
  } kinds[] = {{"range", FlirtKind::range},
               {"blob", FlirtKind::normal_blob},
               {"edge", FlirtKind::normal_edge},
               {"curvature", FlirtKind::curvature}};
  for (const auto& [name, kind] : kinds) {
    const std::string what = std::string(name) + "/" + drive->name;
    benchmark::RegisterBenchmark(("flirt/" + what).c_str(), detect, drive, flirt_defaults(kind))
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("flirtlib_tools/" + what).c_str(), detect, drive, flirtlib_tools(kind))
        ->Unit(benchmark::kMillisecond);
  }
}

void add_all() {
  add(std::make_shared<const Drive>(bench::simulated_drive("room-ellipse-people")));
  const struct {
    const char* name;
    const char* plan;
  } recordings[] = {{"sim_rooms/a1_static", "sim_rooms/a_room4x3.plan.yaml"},
                    {"sim_rooms/b1_ellipse", "sim_rooms/b_room12x8.plan.yaml"}};
  for (const auto& [name, plan] : recordings) {
    auto recorded = bench::recorded_drive(name, plan);
    if (recorded)
      add(std::make_shared<const Drive>(std::move(*recorded)));
    else
      std::cerr << "flirt_bench: no " << name << " below BEACONLESS_DATA: left out\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    add_all();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "flirt_bench: " << error.what() << "\n";
    return 3;
  }
}
