// SPDX-License-Identifier: Apache-2.0
// update() of icp-full, scan by scan over whole drives, on the floor plan and on the grid of it.
#include <cstdlib>
#include <iostream>
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/localize/make_localizer.hpp"

#include "bench/drives.hpp"
#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::Drive;

struct Case {
  std::shared_ptr<const Drive> drive;
  std::shared_ptr<const Map> map;
};

std::unique_ptr<Localizer> localizer_of(const Case& run) {
  return make_localizer({.method = "icp-full", .base_from_laser = run.drive->base_from_laser}, *run.map)
      .value();
}

/// Counts how a run went, because a lost robot's time is no figure of a robot that tracks.
class StatusShare {
 public:
  StatusShare(const char* name, Status status) : name_(name), status_(status) {}

  void count(const PoseEstimate& estimate) {
    ++all_;
    if (estimate.status == status_) ++met_;
  }
  void report(benchmark::State& state) const {
    state.counters[name_] = static_cast<double>(met_) / static_cast<double>(all_);
  }

 private:
  const char* name_;
  Status status_;
  std::int64_t met_ = 0;
  std::int64_t all_ = 0;
};

/// The whole drive from its true start pose.
void track(benchmark::State& state, const Case& run) {
  const auto localizer = localizer_of(run);
  bench::Latencies latencies;
  StatusShare ok("ok_share", Status::ok);
  for (auto _ : state) {
    localizer->start_at(run.drive->truth.front().pose);
    for (const Event& scan : run.drive->scans)
      ok.count(latencies.measure([&] { return localizer->update(scan); }));
  }
  latencies.report(state);
  ok.report(state);
}

/// Every scan as the first after a start: the starts around the guess are searched and the best fitted, as
/// is done with a scan whose fit is doubted.
void doubt(benchmark::State& state, const Case& run) {
  const auto localizer = localizer_of(run);
  bench::Latencies latencies;
  StatusShare ok("ok_share", Status::ok);
  const std::size_t step = std::max<std::size_t>(1, run.drive->scans.size() / 50);
  for (auto _ : state) {
    for (std::size_t i = 0; i < run.drive->scans.size(); i += step) {
      localizer->start_at(run.drive->truth[i].pose);
      ok.count(latencies.measure([&] { return localizer->update(run.drive->scans[i]); }));
    }
  }
  latencies.report(state);
  ok.report(state);
}

/// A scan whose ranges are noise, and which therefore fits nowhere.
Event senseless_scan(const RawScan& like, Rng& rng) {
  RawScan raw = like;
  for (float& range : raw.ranges_m) range = static_cast<float>(rng.uniform(0.5, 8.0));
  return Scan::make(raw).value();
}

/// A robot that knew where it was and sees nothing it knows any more: once it counts as lost, each scan
/// searches the wide window and fits what it finds there, in vain.
void lost(benchmark::State& state, const Case& run) {
  constexpr std::size_t kKnown = 20;
  constexpr std::size_t kUntilLost = 20;
  constexpr std::size_t kMeasured = 20;
  Rng rng(1);
  std::vector<Event> scans(run.drive->scans.begin(), run.drive->scans.begin() + kKnown);
  for (std::size_t i = kKnown; i < kKnown + kUntilLost + kMeasured; ++i)
    scans.push_back(senseless_scan(run.drive->raw_scans[i], rng));
  bench::Latencies latencies;
  StatusShare lost("lost_share", Status::lost);
  for (auto _ : state) {
    const auto localizer = localizer_of(run);
    localizer->start_at(run.drive->truth.front().pose);
    for (std::size_t i = 0; i < kKnown + kUntilLost; ++i) localizer->update(scans[i]);
    for (std::size_t i = kKnown + kUntilLost; i < scans.size(); ++i)
      lost.count(latencies.measure([&] { return localizer->update(scans[i]); }));
  }
  latencies.report(state);
  lost.report(state);
}

void add(const std::string& what, void (*benchmark)(benchmark::State&, const Case&),
         const std::shared_ptr<const Drive>& drive, const std::string& on, Map map) {
  const Case run{drive, std::make_shared<const Map>(std::move(map))};
  benchmark::RegisterBenchmark((what + "/" + drive->name + "/" + on).c_str(), benchmark, run)
      ->Unit(benchmark::kMillisecond);
}

void add_all() {
  for (const char* scenario : {"small-drive", "room-position-1", "room-position-2", "room-ellipse"}) {
    const auto drive = std::make_shared<const Drive>(bench::simulated_drive(scenario));
    const OccupancyGrid grid = bench::grid_of(*drive, 0.05);
    add("track", track, drive, "plan", drive->plan);
    add("track", track, drive, "grid_5cm", grid);
    add("doubt", doubt, drive, "plan", drive->plan);
    add("doubt", doubt, drive, "grid_5cm", grid);
    if (drive->name == "room-position-2") {
      add("lost", lost, drive, "plan", drive->plan);
      add("lost", lost, drive, "grid_5cm", grid);
    }
  }
  const struct {
    const char* name;
    const char* building;
  } recordings[] = {{"sim_rooms/a1_static", "sim_rooms/a_room4x3"},
                    {"sim_rooms/b1_ellipse", "sim_rooms/b_room12x8"}};
  for (const auto& [name, building] : recordings) {
    auto recorded = bench::recorded_drive(name, std::string(building) + ".plan.yaml");
    const std::string grid = bench::recorded_file(std::string(building) + "_r025.yaml");
    if (!recorded || grid.empty()) {
      std::cerr << "localize_bench: no " << name << " below BEACONLESS_DATA: left out\n";
      continue;
    }
    const auto drive = std::make_shared<const Drive>(std::move(*recorded));
    add("track", track, drive, "plan", drive->plan);
    add("track", track, drive, "grid_2.5cm", io::read_map(grid).value());
  }
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
