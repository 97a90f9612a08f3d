// SPDX-License-Identifier: Apache-2.0
// update() of the method walls, scan by scan, in rooms, in a warehouse and on a site of a thousand of them;
// and the index of their walls.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/map/wall_index.hpp"

#include "bench/latencies.hpp"
#include "bench/vector_pace.hpp"
#include "bench/warehouse.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::SharedDrive;

/// The whole drive after its first scan, which searches, from its true start pose.
void track(benchmark::State& state, const SharedDrive& drive, const std::shared_ptr<const Map>& map) {
  const auto localizer =
      make_localizer({.method = "walls", .base_from_laser = drive->base_from_laser}, *map).value();
  bench::Latencies latencies;
  std::int64_t ok = 0;
  std::int64_t all = 0;
  double loop_ms = bench::vector_loop_ms();
  for (auto _ : state) {
    localizer->start_at(drive->truth.front().pose);
    localizer->update(drive->scans.front());
    for (std::size_t i = 1; i < drive->scans.size(); ++i) {
      const PoseEstimate estimate = latencies.measure([&] { return localizer->update(drive->scans[i]); });
      ok += estimate.ok() ? 1 : 0;
      ++all;
    }
  }
  loop_ms = std::min(loop_ms, bench::vector_loop_ms());
  latencies.report(state);
  state.counters["us_per_loop_ms"] = state.counters["p50_us"] / loop_ms;
  state.counters["ok_share"] = static_cast<double>(ok) / static_cast<double>(all);
}

/// The index of so many walls at least, and the memory that it takes.
void build_wall_index(benchmark::State& state) {
  const auto wanted = static_cast<std::size_t>(state.range(0));
  const FloorPlan plan = wanted < 100 ? bench::furnished_room_drive().plan : bench::warehouses(wanted);
  double walls = 0.0;
  double megabytes = 0.0;
  for (auto _ : state) {
    const WallIndex index(plan);
    walls = static_cast<double>(index.wall_count());
    megabytes = 1e-6 * static_cast<double>(index.memory_bytes());
  }
  state.counters["walls"] = walls;
  state.counters["index_MB"] = megabytes;
}

void add(const SharedDrive& drive, const std::string& on, Map map) {
  benchmark::RegisterBenchmark(("track/" + drive->name + "/" + on).c_str(), track, drive,
                               std::make_shared<const Map>(std::move(map)))
      ->Unit(benchmark::kMillisecond);
}

void add_all() {
  for (const SharedDrive& drive : bench::whole_drives()) add(drive, "plan", drive->plan);
  const auto room = std::make_shared<const bench::Drive>(bench::furnished_room_drive());
  const auto hall = std::make_shared<const bench::Drive>(bench::warehouse_drive());
  add(room, "92_walls", room->plan);
  add(hall, "988_walls", hall->plan);
  add(hall, "1e6_walls", bench::warehouses(1'000'000));
  benchmark::RegisterBenchmark("build_wall_index", build_wall_index)
      ->Unit(benchmark::kMillisecond)
      ->Arg(92)
      ->Arg(988)
      ->Arg(100'000)
      ->Arg(1'000'000);
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
