// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// When the next range is not the one that the wall so far foretells.
struct KalmanSegmentationConfig {
  double sigma_m = 0.01;          ///< range noise
  double gate_chi_square = 16.0;  ///< squared innovation in units of its variance above which a segment ends
  double bend_rad = 0.001;        ///< standard deviation by which a wall may turn from beam to beam
  double least_incidence_deg = 5.0;  ///< what a wall may be met at when nothing is known of it
  int min_beams = 1;                 ///< smaller segments are left out
};

void describe(Fields& fields, KalmanSegmentationConfig& config);

/// Buffers that live on from scan to scan.
struct KalmanSegmentationScratch {
  std::vector<std::uint8_t> breaks;
};

/// Cuts a scan where a range is not what a Kalman filter along the wall expects: at jumps and at bends.
///
/// Out: as `segment_by_distance`; on a full circle the filter starts behind the first beam without a hit, or
/// at the farthest beam. Cost: O(beams), some 20 ns each.
///
/// Source: dissertation 2.1.1, which names the method and does not use it; Castellanos and Tardós 1999; gate:
/// Bar-Shalom. Differs: the state is (1/r, its slope): along a straight wall 1/r = cos(θ - alpha)/rho, so the
/// step by Δθ is a turn by Δθ and exact, where (r, dr/dθ) with a constant slope is wrong on every wall. The
/// gate is 16 (four sigmas): the usual 6.63 cuts one beam in a hundred for nothing.
std::vector<ScanSegment> segment_by_kalman(const Scan& scan, const KalmanSegmentationConfig& config = {});
void segment_by_kalman(const Scan& scan, const KalmanSegmentationConfig& config,
                       KalmanSegmentationScratch& scratch, std::vector<ScanSegment>& segments);

}  // namespace beaconless
