// SPDX-License-Identifier: Apache-2.0
// update() of every method by name, scan by scan over whole drives on their floor plans.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/localize/make_localizer.hpp"

#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;

/// The whole drive from its true start pose.
void track(benchmark::State& state, const bench::SharedDrive& drive, const std::string& method) {
  const Map map = drive->plan;
  const auto localizer =
      make_localizer({.method = method, .base_from_laser = drive->base_from_laser}, map).value();
  bench::Latencies latencies;
  std::int64_t ok = 0;
  std::int64_t all = 0;
  for (auto _ : state) {
    localizer->start_at(drive->truth.front().pose);
    for (const Event& scan : drive->scans) {
      const PoseEstimate estimate = latencies.measure([&] { return localizer->update(scan); });
      ok += estimate.ok() ? 1 : 0;
      ++all;
    }
  }
  latencies.report(state);
  state.counters["ok_share"] = static_cast<double>(ok) / static_cast<double>(all);
}

void add_all() {
  for (const bench::SharedDrive& drive : bench::whole_drives())
    for (const Method& method : methods())
      benchmark::RegisterBenchmark((method.name + "/" + drive->name).c_str(), track, drive, method.name)
          ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
