// SPDX-License-Identifier: Apache-2.0
// From beams to corners, step by step, scan by scan over whole drives, and how well corners are found again.
#include <memory>

#include <benchmark/benchmark.h>

#include "beaconless/eval/repeatability.hpp"
#include "beaconless/features/circles.hpp"
#include "beaconless/features/corners.hpp"
#include "beaconless/features/segment_by_kalman.hpp"

#include "bench/latencies.hpp"
#include "bench/whole_drives.hpp"

namespace {

using namespace beaconless;
using bench::each_scan;
using bench::SharedDrive;

void segments_by_distance(benchmark::State& state, const SharedDrive& drive) {
  DistanceSegmentationScratch scratch;
  std::vector<ScanSegment> segments;
  each_scan(state, *drive, [&](const Scan& scan) {
    segment_by_distance(scan, {}, scratch, segments);
    return segments.size();
  });
}

void segments_by_kalman(benchmark::State& state, const SharedDrive& drive) {
  KalmanSegmentationScratch scratch;
  std::vector<ScanSegment> segments;
  each_scan(state, *drive, [&](const Scan& scan) {
    segment_by_kalman(scan, {}, scratch, segments);
    return segments.size();
  });
}

void segments_and_split(benchmark::State& state, const SharedDrive& drive) {
  DistanceSegmentationScratch scratch;
  SplitScratch splitting;
  std::vector<ScanSegment> segments;
  std::vector<ScanSegment> pieces;
  each_scan(state, *drive, [&](const Scan& scan) {
    segment_by_distance(scan, {}, scratch, segments);
    split(scan, segments, {}, splitting, pieces);
    return pieces.size();
  });
}

void lines(benchmark::State& state, const SharedDrive& drive) {
  LinesScratch scratch;
  std::vector<ScanLine> found;
  each_scan(state, *drive, [&](const Scan& scan) {
    find_lines(scan, {}, scratch, found);
    return found.size();
  });
}

void circles(benchmark::State& state, const SharedDrive& drive) {
  CirclesScratch scratch;
  std::vector<ScanCircle> found;
  each_scan(state, *drive, [&](const Scan& scan) {
    find_circles(scan, {}, scratch, found);
    return found.size();
  });
}

/// Whole way, and what eval::repeatability says of the points, ten scans apart.
void corners(benchmark::State& state, const SharedDrive& drive, const CornersConfig& config) {
  CornersScratch scratch;
  std::vector<Corner> found;
  each_scan(state, *drive, [&](const Scan& scan) {
    find_corners(scan, config, scratch, found);
    return found.size();
  });

  std::vector<std::vector<Eigen::Vector2d>> points(drive->scans.size());
  std::vector<eval::View> views;
  for (std::size_t i = 0; i < drive->scans.size(); ++i) {
    find_corners(drive->scan(i), config, scratch, found);
    for (const Corner& corner : found) points[i].push_back(corner.point);
    views.push_back({&drive->scan(i), drive->map_from_laser(i), points[i]});
  }
  const eval::Repeatability again = eval::repeatability(views, 10);
  state.counters["found_ratio"] = again.found_ratio();
  state.counters["mean_mm"] = 1e3 * again.mean_distance_m();
}

void add_all() {
  const std::vector<SharedDrive> drives = bench::whole_drives();
  const auto add = [](const std::string& name, auto&& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  CornersConfig sure;
  sure.reach_beams = 1.0;
  CornersConfig precise;
  precise.max_sigma_m = 0.006;
  for (const SharedDrive& drive : drives) {
    const auto with = [&drive](auto step) {
      return [drive, step](benchmark::State& state) { step(state, drive); };
    };
    add("segment_by_distance/" + drive->name, with(segments_by_distance));
    add("segment_by_kalman/" + drive->name, with(segments_by_kalman));
    add("split/" + drive->name, with(segments_and_split));
    add("find_lines/" + drive->name, with(lines));
    add("find_circles/" + drive->name, with(circles));
    for (const auto& [name, config] : {std::pair<std::string, CornersConfig>{"find_corners/", {}},
                                       {"find_corners_sure/", sure},
                                       {"find_corners_precise/", precise},
                                       {"find_corners_dissertation/", corners_of_the_dissertation()}})
      add(name + drive->name,
          [drive, config = config](benchmark::State& state) { corners(state, drive, config); });
  }
}

}  // namespace

int main(int argc, char** argv) { return beaconless::bench::run_benchmarks(argc, argv, add_all); }
