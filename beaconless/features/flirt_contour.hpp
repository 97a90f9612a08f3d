// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// A stretch of consecutive hits: [begin, end) of the contour's arrays. Keypoints belong to [core_begin,
/// core_end); what lies outside is there so that a closed stretch needs no special case.
struct FlirtStretch {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t core_begin = 0;
  std::size_t core_end = 0;
  bool closed = false;  ///< all around the sensor: the core's ends are neighbours

  std::size_t size() const { return end - begin; }
};

/// The hits of a scan in order, without gaps in memory; sensor frame.
struct FlirtContour {
  std::vector<std::uint32_t> beam;
  std::vector<float> range_m, x_m, y_m;
  std::vector<FlirtStretch> stretches;

  std::size_t size() const { return beam.size(); }
};

/// Gathers the hits of a scan; every beam without one ends a stretch, and so does a distance of more than
/// `max_gap_m` from one point to the next where that is above 0.
///
/// A full circle begins behind a gap, so that no stretch is torn by the end of the arrays. Where it has no
/// gap, `halo` points of its end are repeated before it and as many of its beginning behind it.
void gather_contour(const Scan& scan, double max_gap_m, std::size_t halo, FlirtContour& contour);

}  // namespace beaconless
