// SPDX-License-Identifier: Apache-2.0
// Scans at known poses into an occupancy grid.
#include <benchmark/benchmark.h>

#include "beaconless/map/grid_builder.hpp"

#include "bench/drives.hpp"

namespace {

using namespace beaconless;

const bench::Drive& ellipse() {
  static const bench::Drive drive = bench::simulated_drive("room-ellipse");
  return drive;
}

GridBuilderConfig config_of(const benchmark::State& state) {
  return {.resolution_m = 0.001 * static_cast<double>(state.range(0))};
}

/// One scan into a grid that has seen the room already.
void add(benchmark::State& state) {
  const bench::Drive& drive = ellipse();
  auto builder = GridBuilder::make(config_of(state)).value();
  for (std::size_t i = 0; i < drive.scans.size(); i += 40)
    builder.add(drive.scan(i), drive.map_from_laser(i)).value();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(builder.add(drive.scan(i), drive.map_from_laser(i)));
    i = (i + 1) % drive.scans.size();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(add)->ArgName("cell_mm")->Arg(50)->Arg(25)->Arg(10)->Unit(benchmark::kMicrosecond);

/// A whole map: 160 scans into a grid that grows from nothing, and the grid taken out.
void build(benchmark::State& state) {
  const bench::Drive& drive = ellipse();
  std::int64_t scans = 0;
  for (auto _ : state) {
    auto builder = GridBuilder::make(config_of(state)).value();
    for (std::size_t i = 0; i < drive.scans.size(); i += 10, ++scans)
      builder.add(drive.scan(i), drive.map_from_laser(i)).value();
    benchmark::DoNotOptimize(builder.grid());
  }
  state.SetItemsProcessed(scans);
}
BENCHMARK(build)->ArgName("cell_mm")->Arg(50)->Arg(25)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
