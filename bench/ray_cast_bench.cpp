// SPDX-License-Identifier: Apache-2.0
// The first wall on a ray's way, and a whole simulated sweep, among few walls and many.
#include <benchmark/benchmark.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/io/plan_io.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/sim/lidar.hpp"

#include "bench/drives.hpp"

namespace {

using namespace beaconless;

/// A hall of 50 x 40 m with `pillars` square pillars in it that stand askew, four walls each.
FloorPlan pillared_hall(int pillars) {
  FloorPlan plan{{{{0, 0}, {50, 0}, {50, 40}, {0, 40}, {0, 0}}}};
  Rng rng(1);
  for (int i = 0; i < pillars; ++i) {
    const Pose2 map_from_pillar{rng.uniform(1, 49), rng.uniform(1, 39), rng.uniform(-kPi, kPi)};
    const double half_m = rng.uniform(0.05, 0.3);
    FloorPlan::Polyline outline;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
      outline.push_back(map_from_pillar * Eigen::Vector2d(half_m * x, half_m * y));
    plan.walls.push_back(std::move(outline));
  }
  return plan;
}

FloorPlan small_room() { return bench::simulated_drive("small-static").plan; }
FloorPlan full_room() { return bench::simulated_drive("room-position-1").plan; }
FloorPlan hall_of_1000_walls() { return pillared_hall(249); }

struct Ray {
  Eigen::Vector2d origin;
  Eigen::Vector2d direction;
};

/// Rays from everywhere within a plan's bounds in every direction.
std::vector<Ray> rays_in(const FloorPlan& plan) {
  const FloorPlan::Bounds bounds = plan.bounds();
  Rng rng(2);
  std::vector<Ray> rays(10'000);
  for (auto& [origin, direction] : rays) {
    origin = {rng.uniform(bounds.low.x(), bounds.high.x()), rng.uniform(bounds.low.y(), bounds.high.y())};
    const double bearing = rng.uniform(-kPi, kPi);
    direction = {std::cos(bearing), std::sin(bearing)};
  }
  return rays;
}

void cast(benchmark::State& state, FloorPlan (*plan_of)()) {
  const FloorPlan plan = plan_of();
  const RayCaster walls(plan.segments());
  const std::vector<Ray> rays = rays_in(plan);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(walls.cast(rays[i].origin, rays[i].direction, 30.0));
    if (++i == rays.size()) i = 0;
  }
  state.counters["walls"] = static_cast<double>(walls.segments().size());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(cast, small_room, small_room);
BENCHMARK_CAPTURE(cast, full_room, full_room);
BENCHMARK_CAPTURE(cast, hall, hall_of_1000_walls);

/// 1081 beams with noise, from the middle of the plan.
void measure_sweep(benchmark::State& state, FloorPlan (*plan_of)()) {
  const FloorPlan plan = plan_of();
  const sim::World world(plan, {});
  const FloorPlan::Bounds bounds = plan.bounds();
  const Eigen::Vector2d middle = 0.5 * (bounds.low + bounds.high);
  const sim::LaserMotion standing = [&middle](double) { return Pose2{middle.x(), middle.y(), 0.1}; };
  const sim::LidarConfig lidar;
  Rng rng(3);
  for (auto _ : state) benchmark::DoNotOptimize(sim::measure_sweep(world, lidar, standing, 0.0, rng));
  state.counters["walls"] = static_cast<double>(world.walls().segments().size());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(measure_sweep, small_room, small_room)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(measure_sweep, full_room, full_room)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(measure_sweep, hall, hall_of_1000_walls)->Unit(benchmark::kMicrosecond);

void build_ray_caster(benchmark::State& state, FloorPlan (*plan_of)()) {
  const std::vector<Segment2> segments = plan_of().segments();
  for (auto _ : state) benchmark::DoNotOptimize(RayCaster(segments));
  state.counters["walls"] = static_cast<double>(segments.size());
}
BENCHMARK_CAPTURE(build_ray_caster, hall, hall_of_1000_walls)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
