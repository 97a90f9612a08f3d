// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// How far apart two neighbouring beams of one object may end.
enum class DistanceThreshold : int {
  constant,      ///< constant_m
  dietmayer,     ///< 3√2 sigma + C1 r, C1 = 2 sin(Δθ/2): the spacing on a wall that is met head-on
  santos,        ///< 3√2 sigma + r sin Δθ / cos(beta + Δθ/2): … on a wall turned by beta
  borges_aldon,  ///< 3 sigma + r sin Δθ / sin(lambda - Δθ): … on a wall met at the angle lambda
  lee,           ///< |r1 - r2| above lee_ratio (r1 + r2), whatever the spacing
};

/// When neighbouring beams belong to different objects. r is the lesser of both ranges.
struct DistanceSegmentationConfig {
  DistanceThreshold threshold = DistanceThreshold::borges_aldon;
  double sigma_m = 0.01;     ///< range noise
  double constant_m = 0.10;  ///< of `constant`
  double beta_deg = 80.0;    ///< of `santos`: most that a wall may be turned away from head-on
  double lambda_deg = 10.0;  ///< of `borges_aldon`: least angle between beam and wall
  double lee_ratio = 0.02;   ///< of `lee`
  int min_beams = 1;         ///< smaller segments are left out
};

void describe(Fields& fields, DistanceSegmentationConfig& config);

/// Buffers that live on from scan to scan.
struct DistanceSegmentationScratch {
  std::vector<std::uint8_t> breaks;
};

/// Cuts a scan where neighbouring beams end too far apart, and at every beam that is no hit.
///
/// Out: segments in order of their first beams. On a full circle the last and the first beam are neighbours
/// too: a segment may run over the end and is then the last; a contour without any break begins at its
/// farthest beam, which is a corner of it where it has corners. No hits: no segments. Cost: O(beams), about
/// 1 us for 1081.
///
/// Source: dissertation 2.1.1 and Algorithm 1; Dietmayer et al. 2001; Santos et al. 2003; Lee 2001; Borges
/// and Aldon 2004. D² = (r1 - r2)² + 4 r1 r2 sin²(Δθ/2), which is the law of cosines without its
/// cancellation. Differs: (1) Algorithm 1 tests a stale j, never resets k and never assigns the last beam.
/// (2) The forms of Santos that are in print, C1 r / (cot b cos(Δθ/2) - sin(Δθ/2)) here and cot b (cos - sin)
/// elsewhere, are the depth along the bisector but are compared with a distance: as b goes to 0 they vanish
/// although neighbours stay C1 r apart. By the sine rule the chord is r sin Δθ / cos(b + Δθ/2), the same as
/// Borges-Aldon with lambda = 90° + Δθ/2 - b. (3) Borges-Aldon takes the lesser range, not that of the
/// earlier beam, so that a mirrored scan is cut at the same places.
std::vector<ScanSegment> segment_by_distance(const Scan& scan, const DistanceSegmentationConfig& config = {});
void segment_by_distance(const Scan& scan, const DistanceSegmentationConfig& config,
                         DistanceSegmentationScratch& scratch, std::vector<ScanSegment>& segments);

/// The threshold for a pair of neighbours whose lesser range is `range_m`; of `lee`, the one for equal
/// ranges.
double distance_threshold_m(const DistanceSegmentationConfig& config, double angle_increment_rad,
                            double range_m);

}  // namespace beaconless
