// SPDX-License-Identifier: Apache-2.0
// How long FLIRT takes for one scan, with the defaults and with the parameters of flirtlib's tools.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/features/flirt.hpp"

#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::Drive;

void detect(benchmark::State& state, const std::shared_ptr<const Drive>& drive, const FlirtConfig& config) {
  FlirtScratch scratch;
  std::vector<Keypoint> keypoints;
  bench::each_scan(state, *drive, [&](const Scan& scan) {
    detect_flirt(scan, config, scratch, keypoints);
    return keypoints.size();
  });
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
  for (const bench::SharedDrive& drive : bench::whole_drives("room-ellipse-people")) add(drive);
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
