// SPDX-License-Identifier: Apache-2.0
// FALKO and OC, scan by scan over whole drives, with the neighbourhoods that both begin with.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/features/falko.hpp"
#include "beaconless/features/oc.hpp"

#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::each_scan;
using bench::SharedDrive;

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
  const std::vector<SharedDrive> drives = bench::whole_drives();
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

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
