// SPDX-License-Identifier: Apache-2.0
#include "reproduce_times.hpp"

#include <algorithm>
#include <chrono>

#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/features/split.hpp"

namespace beaconless::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// What lives on from scan to scan, as in a program that localizes.
struct Buffers {
  DistanceSegmentationScratch segmentation;
  SplitScratch splitting;
  std::vector<ScanSegment> segments;
  std::vector<ScanSegment> pieces;
};

/// Every scan whole: only beams that are no hits part it.
DistanceSegmentationConfig undivided() {
  return {.threshold = DistanceThreshold::constant, .constant_m = 100.0};
}

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

SegmentationTimes time_segmentation(const sim::SimulatedRun& run, int passes) {
  SegmentationTimes times;
  Buffers buffers;
  std::vector<double> taken_us;
  taken_us.reserve(run.events.size() * static_cast<std::size_t>(passes));
  for (std::size_t row = 0; row < kTable42.size(); ++row)
    for (std::size_t column = 0; column < kTable42Epsilons_m.size(); ++column) {
      const double threshold_m = kTable42[row].threshold_m;
      const DistanceSegmentationConfig segmentation =
          threshold_m > 0.0 ? DistanceSegmentationConfig{.threshold = DistanceThreshold::constant,
                                                         .constant_m = threshold_m}
                            : undivided();
      const SplitConfig splitting{.epsilon_m = kTable42Epsilons_m[column]};
      taken_us.clear();
      for (int pass = 0; pass < passes; ++pass)
        for (const Event& event : run.events) {
          const Scan& scan = std::get<Scan>(event);
          const auto begin = Clock::now();
          segment_by_distance(scan, segmentation, buffers.segmentation, buffers.segments);
          split(scan, buffers.segments, splitting, buffers.splitting, buffers.pieces);
          taken_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
        }
      times.median_us[row][column] = median(taken_us);
    }
  return times;
}

}  // namespace beaconless::cli
