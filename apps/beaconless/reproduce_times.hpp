// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "reproduce_published.hpp"
#include "reproduce_scenes.hpp"

namespace beaconless::cli {

/// Table 4.2 as this machine measures it: median microseconds a scan, by row and epsilon of kTable42. Not the
/// same twice.
struct SegmentationTimes {
  std::array<std::array<double, kTable42Epsilons_m.size()>, kTable42.size()> median_us{};
};

/// Takes the time of segmentation and split of every scan of a run, `passes` times.
SegmentationTimes time_segmentation(const sim::SimulatedRun& run, int passes);

}  // namespace beaconless::cli
