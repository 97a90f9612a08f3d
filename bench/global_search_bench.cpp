// SPDX-License-Identifier: Apache-2.0
// A robot that may be anywhere: the search of the whole map and all headings with one scan, and the whole
// first look of PlaceFinder, at random places of grids of 5 cm that are read as walls.
#include <algorithm>
#include <fstream>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/localize/place_finder.hpp"
#include "beaconless/map/rasterize.hpp"
#include "beaconless/match/grid_outlines.hpp"
#include "beaconless/sim/lidar.hpp"

#include "bench/latencies.hpp"
#include "bench/office.hpp"
#include "bench/warehouse.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;

constexpr double kClear_m = 0.6;  // no robot stands nearer to a wall
constexpr double kFound_m = 0.3;
constexpr double kFound_rad = radians(5.0);

struct Stand {
  Pose2 map_from_laser;
  std::vector<Eigen::Vector2d> points;
};

/// A map as a robot has it, and places in the building.
struct Site {
  std::shared_ptr<const SurfaceMap> map;
  std::vector<Stand> stands;
  PlacesConfig places;
};

double resident_megabytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0.0;
  double resident = 0.0;
  statm >> all >> resident;
  return 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Site site_of(const FloorPlan& plan, int stands) {
  const OccupancyGrid grid = rasterize(plan).value();
  Site site;
  site.map = std::make_shared<const SurfaceMap>(
      build_surface_map(outlines_of(grid, {.thin_cells = 4}), IcpConfig{}.max_pair_distance_m).value());
  const sim::World world(plan, {});
  const FloorPlan::Bounds box = plan.bounds();
  Rng rng(3);
  while (static_cast<int>(site.stands.size()) < stands) {
    const Pose2 pose{rng.uniform(box.low.x(), box.high.x()), rng.uniform(box.low.y(), box.high.y()),
                     rng.uniform(-kPi, kPi)};
    const auto surface = std::get<WallIndex>(*site.map).nearest(pose.translation());
    if (surface && surface->distance_m < kClear_m) continue;
    const RawScan scan = measure_sweep(
        world, {}, [&](double) { return pose; }, 0.0, rng);
    site.stands.push_back({pose, bench::points_of(Scan::make(scan).value())});
  }
  return site;
}

/// Built once for all benchmarks on the same plan.
const Site& site_named(const std::string& name) {
  static std::string of_name;
  static std::unique_ptr<Site> site;
  if (of_name == name) return *site;
  site.reset();
  if (name == "warehouse_60x40") site = std::make_unique<Site>(site_of(bench::warehouse(), 200));
  if (name == "office_60x40") site = std::make_unique<Site>(site_of(bench::office({60.0, 40.0}, 1), 200));
  if (name == "office_200x200") site = std::make_unique<Site>(site_of(bench::office({200.0, 200.0}, 2), 40));
  of_name = name;
  return *site;
}

bool is_at(const Pose2& pose, const Pose2& truth) {
  return distance_m(pose, truth) < kFound_m && heading_difference_rad(pose, truth) < kFound_rad;
}

clockid_t clock_for(int threads) { return threads > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID; }

/// search_everywhere() alone: is the true place the best, and one of those that it gives?
void search(benchmark::State& state, const std::string& name) {
  const Site& site = site_named(name);
  GlobalSearchConfig config = site.places.search;
  config.threads = static_cast<int>(state.range(0));
  const NearnessPyramid nearness(*site.map, config.cell_m, config.truncate_m);
  GlobalSearchScratch scratch;
  std::vector<StartPose> found;
  bench::Latencies latencies(clock_for(config.threads));
  double all = 0.0;
  double first = 0.0;
  double among = 0.0;
  double kept = 0.0;
  for (auto _ : state)
    for (const Stand& stand : site.stands) {
      latencies.measure([&] {
        search_everywhere(stand.points, nearness, bounds_of(*site.map), config, scratch, found);
        return found.size();
      });
      const auto is_true = [&](const StartPose& start) {
        return is_at(start.map_from_laser, stand.map_from_laser);
      };
      all += 1.0;
      kept += static_cast<double>(found.size());
      first += !found.empty() && is_true(found.front()) ? 1.0 : 0.0;
      among += std::any_of(found.begin(), found.end(), is_true) ? 1.0 : 0.0;
    }
  latencies.report(state);
  state.counters["true_first"] = first / all;
  state.counters["true_among"] = among / all;
  state.counters["places"] = kept / all;
  state.counters["cell_m"] = nearness.cell_m();
  state.counters["pyramid_MB"] = 1e-6 * static_cast<double>(nearness.bytes());
}

/// PlaceFinder's first look: the search, and every place that it gives fitted and weighed with the whole
/// scan.
void see(benchmark::State& state, const std::string& name) {
  const Site& site = site_named(name);
  PlacesConfig config = site.places;
  config.search.threads = static_cast<int>(state.range(0));
  const double before = resident_megabytes();
  PlaceFinder finder(config, site.map, {}, {});
  bench::Latencies latencies(clock_for(config.search.threads));
  double all = 0.0;
  double right = 0.0;
  double wrong = 0.0;
  double several = 0.0;
  double listed = 0.0;
  for (auto _ : state)
    for (const Stand& stand : site.stands) {
      finder.begin();
      const auto verdict = latencies.measure([&] { return finder.see({}, stand.points, std::nullopt); });
      const auto is_true = [&](const PlaceFinder::Place& place) {
        return is_at(place.map_from_laser, stand.map_from_laser);
      };
      const auto likely = finder.likely();
      const bool is_first = !likely.empty() && is_true(likely.front());
      all += 1.0;
      right += verdict == PlaceFinder::Verdict::one && is_first ? 1.0 : 0.0;
      wrong += verdict == PlaceFinder::Verdict::one && !is_first ? 1.0 : 0.0;
      several += verdict == PlaceFinder::Verdict::several ? 1.0 : 0.0;
      listed += std::any_of(likely.begin(), likely.end(), is_true) ? 1.0 : 0.0;
    }
  latencies.report(state);
  state.counters["right"] = right / all;
  state.counters["wrong"] = wrong / all;
  state.counters["several"] = several / all;
  state.counters["true_likely"] = listed / all;
  state.counters["walls_MB"] = 1e-6 * static_cast<double>(std::get<WallIndex>(*site.map).memory_bytes());
  state.counters["finder_MB"] = resident_megabytes() - before;
}

void add(const std::string& verb, const std::string& site,
         void (*run)(benchmark::State&, const std::string&)) {
  benchmark::RegisterBenchmark((verb + "/" + site).c_str(), run, site)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->Iterations(1)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

void add_all() {
  for (const std::string site : {"warehouse_60x40", "office_60x40", "office_200x200"}) {
    add("search", site, search);
    add("see", site, see);
  }
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
