// SPDX-License-Identifier: Apache-2.0
// FALKO and OC, scan by scan over whole drives, with the neighbourhoods that both begin with.
#include <iostream>
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/features/falko.hpp"
#include "beaconless/features/oc.hpp"

#include "bench/drives.hpp"
#include "bench/latencies.hpp"

namespace {

using namespace beaconless;
using bench::Drive;
using bench::each_scan;
using SharedDrive = std::shared_ptr<const Drive>;

void neighbourhoods(benchmark::State& state, const SharedDrive& drive) {
  BeamNeighbourhoods around;
  each_scan(state, *drive, [&](const Scan& scan) {
    around.assign(scan, FalkoConfig{}.radius);
    return around.first.size();
  });
}

void falko(benchmark::State& state, const SharedDrive& drive, const FalkoConfig& config) {
  FalkoScratch scratch;
  std::vector<Keypoint> keypoints;
  each_scan(state, *drive, [&](const Scan& scan) {
    detect_falko(scan, config, scratch, keypoints);
    return keypoints.size();
  });
}

void oc(benchmark::State& state, const SharedDrive& drive) {
  OcScratch scratch;
  std::vector<Keypoint> keypoints;
  each_scan(state, *drive, [&](const Scan& scan) {
    detect_oc(scan, {}, scratch, keypoints);
    return keypoints.size();
  });
}

void add_all() {
  std::vector<SharedDrive> drives = {std::make_shared<const Drive>(bench::simulated_drive("room-ellipse"))};
  for (const auto& [name, plan] : {std::pair{"sim_rooms/a1_static", "sim_rooms/a_room4x3.plan.yaml"},
                                   std::pair{"sim_rooms/b1_ellipse", "sim_rooms/b_room12x8.plan.yaml"}}) {
    if (auto drive = bench::recorded_drive(name, plan))
      drives.push_back(std::make_shared<const Drive>(std::move(*drive)));
    else
      std::cerr << "keypoint_bench: no " << name << " below BEACONLESS_DATA: left out\n";
  }
  const auto add = [](const std::string& name, auto&& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  for (const SharedDrive& drive : drives) {
    add("neighbourhoods/" + drive->name, [drive](benchmark::State& state) { neighbourhoods(state, drive); });
    for (const char* preset : {"beaconless", "authors", "dissertation"})
      add("falko_" + std::string(preset) + "/" + drive->name,
          [drive, config = falko_preset(preset).value()](benchmark::State& state) {
            falko(state, drive, config);
          });
    add("oc/" + drive->name, [drive](benchmark::State& state) { oc(state, drive); });
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
    std::cerr << "keypoint_bench: " << error.what() << "\n";
    return 3;
  }
}
