// SPDX-License-Identifier: Apache-2.0
// The descriptors of a scan's keypoints and the regions around them, scan by scan over whole drives. The
// keypoints are the corners of the floor plan that the laser sees, so that the figures do not hang on a
// detector.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/features/beta_grid.hpp"
#include "beaconless/features/bsc.hpp"
#include "beaconless/features/cgh.hpp"
#include "beaconless/features/interest_regions.hpp"
#include "beaconless/features/shape_context.hpp"

#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;

/// Scans, and which of the plan's corners each of them sees.
struct Case {
  std::string name;
  std::vector<Scan> scans;
  std::vector<std::vector<Keypoint>> keypoints;

  double keypoints_per_scan() const {
    std::size_t all = 0;
    for (const auto& some : keypoints) all += some.size();
    return static_cast<double>(all) / static_cast<double>(keypoints.size());
  }
};

/// A corner is seen where a beam ends near it.
std::vector<Keypoint> seen_corners(const Scan& scan, const FloorPlan& plan, const Pose2& map_from_laser) {
  std::vector<Keypoint> seen;
  for (const Segment2& wall : plan.segments()) {
    const Eigen::Vector2d corner = map_from_laser.inverse() * wall.a;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (!scan.is_hit(beam) || (scan.point(beam) - corner).norm() > 0.1) continue;
      seen.push_back({.beam = beam, .point = corner, .orientation_rad = 0.3});
      break;
    }
  }
  return seen;
}

Case case_of(const bench::Drive& drive) {
  Case run{.name = drive.name};
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    run.scans.push_back(drive.scan(i));
    run.keypoints.push_back(seen_corners(drive.scan(i), drive.plan, drive.map_from_laser(i)));
  }
  return run;
}

/// Times `describe(scan, keypoints)` on every scan that has keypoints.
template <class Describe>
void time_scans(benchmark::State& state, const Case& run, const Describe& describe) {
  bench::Latencies latencies;
  for (auto _ : state)
    for (std::size_t i = 0; i < run.scans.size(); ++i) {
      if (run.keypoints[i].empty()) continue;
      latencies.measure([&] {
        describe(run.scans[i], run.keypoints[i]);
        return i;
      });
    }
  latencies.report(state);
  state.counters["per_scan"] = run.keypoints_per_scan();
  state.counters["p50_us_each"] = state.counters["p50_us"] / run.keypoints_per_scan();
}

template <class Config, class Out,
          void (*Describe)(const Scan&, std::span<const Keypoint>, const Config&, Out&)>
void time_one(benchmark::State& state, const Case& run) {
  Out out;
  const Config config;
  time_scans(state, run, [&](const Scan& scan, const std::vector<Keypoint>& keypoints) {
    Describe(scan, keypoints, config, out);
    benchmark::DoNotOptimize(out);
  });
}

void add_all() {
  std::vector<std::shared_ptr<const Case>> cases;
  for (const bench::SharedDrive& drive : bench::whole_drives())
    cases.push_back(std::make_shared<const Case>(case_of(*drive)));
  const auto add = [&](const char* what, void (*benchmark)(benchmark::State&, const Case&)) {
    for (const auto& run : cases)
      benchmark::RegisterBenchmark((std::string(what) + "/" + run->name).c_str(),
                                   [benchmark, run](benchmark::State& state) { benchmark(state, *run); })
          ->Unit(benchmark::kMillisecond);
  };
  add("bsc", time_one<BscConfig, std::vector<BscDescriptor>, describe_bsc>);
  add("cgh", time_one<CghConfig, std::vector<CghDescriptor>, describe_cgh>);
  add("shape_context", time_one<ShapeContextConfig, std::vector<ShapeContext>, describe_shape_context>);
  add("beta_grid", time_one<BetaGridConfig, std::vector<BetaGrid>, describe_beta_grid>);
  add("interest_regions", time_one<InterestRegionsConfig, InterestRegions, find_interest_regions>);
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
