// SPDX-License-Identifier: Apache-2.0
// update() of the method walls, scan by scan, in rooms, in a warehouse and on a site of a thousand of them;
// the index of their walls; many robots at once.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/walls_batch.hpp"

#include "bench/latencies.hpp"
#include "bench/vector_pace.hpp"
#include "bench/warehouse.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::SharedDrive;

constexpr int kHallsOfAMillionWalls = 32;  // along each side of a site

/// A drive on a map, with the localizer that every repetition uses: an index of a million walls takes
/// seconds.
struct Case {
  SharedDrive drive;
  Map map;
  std::unique_ptr<Localizer> localizer;
};

/// The whole drive after its first scan, which searches, from its true start pose.
void track(benchmark::State& state, const std::shared_ptr<Case>& run) {
  const SharedDrive& drive = run->drive;
  auto& localizer = run->localizer;
  if (localizer == nullptr)
    localizer =
        make_localizer({.method = "walls", .base_from_laser = drive->base_from_laser}, run->map).value();
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

/// The index of the walls of a room (no hall), or of so many halls along each side.
void build_wall_index(benchmark::State& state) {
  const auto halls = static_cast<int>(state.range(0));
  const FloorPlan plan = halls == 0 ? bench::furnished_room_drive().plan : bench::warehouses(halls);
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

/// Built once for all repetitions on the same site.
const WallIndex& index_of(int halls) {
  static int of_halls = 0;
  static std::unique_ptr<const WallIndex> index;
  if (of_halls != halls) index = std::make_unique<const WallIndex>(bench::warehouses(halls));
  of_halls = halls;
  return *index;
}

/// A thousand robots with a scan each, all in one hall or each in a hall of its own, from guesses as they are
/// in steady tracking.
void match_a_thousand(benchmark::State& state) {
  constexpr std::size_t kRobots = 1000;
  constexpr double kPrior_m = 0.015;
  constexpr double kPeriod_us = 40'000.0;  // of scans at 25 Hz
  const auto halls = static_cast<int>(state.range(0));
  const bench::Drive drive = bench::warehouse_drive();
  const WallIndex& index = index_of(halls);
  std::vector<std::vector<Eigen::Vector2d>> scans;
  std::vector<WallsTask> tasks;
  std::vector<Pose2> truth;
  Rng rng(8);
  for (std::size_t robot = 0; robot < kRobots; ++robot) {
    const std::size_t i = robot * drive.scans.size() / kRobots;
    const auto hall = static_cast<int>(robot) % (halls * halls);
    const Eigen::Vector2d at = bench::hall_at(halls, hall % halls, hall / halls);
    const Pose2 there = drive.map_from_laser(i);
    truth.push_back({there.x_m + at.x(), there.y_m + at.y(), there.theta_rad});
    scans.push_back(bench::points_of(drive.scan(i)));
    const Pose2 off{rng.normal(0.002), rng.normal(0.002), rng.normal(0.0005)};
    tasks.push_back({scans.back(), truth.back() * off, kPrior_m});
  }
  WallsScratch scratch;
  std::vector<MatchResult> results(kRobots);
  bench::Latencies latencies;
  for (auto _ : state) {
    latencies.measure([&] {
      match_walls_all(tasks, index, {}, scratch, results);
      return 0;
    });
  }
  latencies.report(state);
  std::int64_t found = 0;
  for (std::size_t robot = 0; robot < kRobots; ++robot)
    found += distance_m(results[robot].map_from_laser, truth[robot]) < 0.01 ? 1 : 0;
  state.counters["budget_share"] = state.counters["p50_us"] / kPeriod_us;
  state.counters["found_share"] = static_cast<double>(found) / static_cast<double>(kRobots);
}

void add(const SharedDrive& drive, const std::string& on, Map map) {
  const auto run = std::make_shared<Case>(Case{drive, std::move(map), nullptr});
  benchmark::RegisterBenchmark(("track/" + drive->name + "/" + on).c_str(), track, run)
      ->Unit(benchmark::kMillisecond);
}

void add_all() {
  for (const SharedDrive& drive : bench::whole_drives()) add(drive, "plan", drive->plan);
  const auto room = std::make_shared<const bench::Drive>(bench::furnished_room_drive());
  const auto hall = std::make_shared<const bench::Drive>(bench::warehouse_drive());
  add(room, "92_walls", room->plan);
  add(hall, "988_walls", hall->plan);
  add(hall, "1e6_walls", bench::warehouses(kHallsOfAMillionWalls));
  benchmark::RegisterBenchmark("build_wall_index", build_wall_index)
      ->Unit(benchmark::kMillisecond)
      ->ArgName("halls_a_side")
      ->Arg(0)
      ->Arg(1)
      ->Arg(10)
      ->Arg(kHallsOfAMillionWalls);
  benchmark::RegisterBenchmark("match_a_thousand", match_a_thousand)
      ->Unit(benchmark::kMillisecond)
      ->ArgName("halls_a_side")
      ->Arg(1)
      ->Arg(kHallsOfAMillionWalls);
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
