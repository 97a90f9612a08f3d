// SPDX-License-Identifier: Apache-2.0
// One fit of a scan to a map, the look-ups it consists of, and what the indexes cost once.
#include <array>

#include <benchmark/benchmark.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/match/icp.hpp"
#include "beaconless/match/local_search.hpp"

#include "bench/drives.hpp"

namespace {

using namespace beaconless;

/// The middle of the full room: scans, guesses as far off as predictions are, both indexes.
struct Scene {
  static constexpr std::size_t kScans = 64;

  bench::Drive drive = bench::simulated_drive("room-position-2");
  OccupancyGrid grid = bench::grid_of(drive, 0.05);
  WallIndex walls{drive.plan};
  CellIndex cells{grid};
  std::vector<std::vector<Eigen::Vector2d>> points;  // of each scan, laser frame
  std::vector<Pose2> guesses;                        // map_from_laser
  std::vector<Eigen::Vector2d> queries;  // points of the scans as the guesses put them into the map

  Scene() {
    Rng rng(1);
    for (std::size_t i = 0; i < kScans; ++i) {
      points.push_back(bench::points_of(drive.scan(i)));
      guesses.push_back(drive.map_from_laser(i) *
                        Pose2{rng.normal(0.03), rng.normal(0.03), rng.normal(radians(1.0))});
      for (const Eigen::Vector2d& point : points.back()) queries.push_back(guesses.back() * point);
    }
  }
};

const Scene& scene() {
  static const Scene scene;
  return scene;
}

template <SurfaceIndex Index>
const Index& index_of(const Scene& of) {
  if constexpr (std::same_as<Index, WallIndex>)
    return of.walls;
  else
    return of.cells;
}

template <SurfaceIndex Index>
void match(benchmark::State& state, const IcpConfig& config) {
  const Scene& from = scene();
  const Index& map = index_of<Index>(from);
  IcpScratch scratch;
  std::size_t i = 0;
  double iterations = 0.0;
  for (auto _ : state) {
    const MatchResult result = match_icp(from.points[i], map, from.guesses[i], config, scratch);
    iterations += result.iterations;
    i = (i + 1) % Scene::kScans;
  }
  state.counters["icp_iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
  state.SetItemsProcessed(state.iterations());
}

void match_icp_plan(benchmark::State& state, const IcpConfig& config) { match<WallIndex>(state, config); }
void match_icp_grid(benchmark::State& state, const IcpConfig& config) { match<CellIndex>(state, config); }

BENCHMARK_CAPTURE(match_icp_plan, huber, {.loss = LossKind::huber})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_plan, cauchy, {.loss = LossKind::cauchy})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_plan, tukey, {.loss = LossKind::tukey})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_plan, welsch, {.loss = LossKind::welsch})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_plan, geman_mcclure, {.loss = LossKind::geman_mcclure})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_plan, alignment_solver, {.solver = IcpSolver::alignment})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_grid, huber, {.loss = LossKind::huber})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_grid, cauchy, {.loss = LossKind::cauchy})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_grid, tukey, {.loss = LossKind::tukey})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_grid, welsch, {.loss = LossKind::welsch})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match_icp_grid, geman_mcclure, {.loss = LossKind::geman_mcclure})
    ->Unit(benchmark::kMicrosecond);

void search_around_guess(benchmark::State& state) {
  const Scene& from = scene();
  const NearnessPyramid map{SurfaceMap(from.walls)};
  LocalSearchConfig config;
  config.window_m = 0.1 * static_cast<double>(state.range(0));
  config.window_deg = static_cast<double>(state.range(1));
  LocalSearchScratch scratch;
  std::vector<StartPose> starts;
  std::size_t i = 0;
  for (auto _ : state) {
    search_around(from.points[i], map, from.guesses[i], config, scratch, starts);
    i = (i + 1) % Scene::kScans;
  }
}
BENCHMARK(search_around_guess)
    ->ArgNames({"window_dm", "window_deg"})
    ->Args({12, 50})
    ->Args({30, 180})
    ->Unit(benchmark::kMicrosecond);

template <SurfaceIndex Index>
void nearest(benchmark::State& state) {
  const Scene& from = scene();
  const Index& map = index_of<Index>(from);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(map.nearest(from.queries[i]));
    if (++i == from.queries.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(nearest<WallIndex>);
BENCHMARK(nearest<CellIndex>);

void build_wall_index(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(WallIndex(scene().drive.plan));
}
BENCHMARK(build_wall_index)->Unit(benchmark::kMillisecond);

void build_nearness_pyramid(benchmark::State& state) {
  const SurfaceMap walls(scene().walls);
  for (auto _ : state) benchmark::DoNotOptimize(NearnessPyramid(walls));
}
BENCHMARK(build_nearness_pyramid)->Unit(benchmark::kMillisecond);

void build_cell_index(benchmark::State& state) {
  const OccupancyGrid grid = bench::grid_of(scene().drive, 0.001 * static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(CellIndex(grid));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(grid.occupancy_percent.size()));
}
BENCHMARK(build_cell_index)->ArgName("cell_mm")->Arg(50)->Arg(25)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
