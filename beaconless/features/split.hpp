// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/ordered_points.hpp"
#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// How far points may stray from the straight pieces that replace them.
struct SplitConfig {
  double epsilon_m = 0.05;  ///< five sigmas of a 10 mm laser: noise alone goes to sigma √(2 ln n), 35 mm
};

void describe(Fields& fields, SplitConfig& config);

/// Buffers that live on from call to call.
struct SplitScratch {
  std::vector<std::pair<std::size_t, std::size_t>> stack;
  std::vector<std::size_t> vertices;
  OrderedPointsScratch points;
};

/// Straight pieces by iterative end-point fit: the vertices that are kept of a row of points, ascending, with
/// both ends.
///
/// A piece is cut at its point farthest from the line through its ends, as long as that is further than
/// epsilon. Ends that coincide (a closed contour) take the distance from them. No points: no vertices; one:
/// that. Cost: O(n log n) as a rule, O(n²) at worst. Source: Ramer 1972; Douglas and Peucker 1973;
/// dissertation Algorithm 2. Differs: an explicit stack and no copies; Algorithm 2 recurses inside the loop,
/// for each point, and drops the last point of its second half. Vertices are raw points with all their noise:
/// fit lines to the pieces before calling anything a corner.
std::vector<std::size_t> split(std::span<const Eigen::Vector2d> points, const SplitConfig& config = {});
void split(std::span<const Eigen::Vector2d> points, const SplitConfig& config, SplitScratch& scratch,
           std::vector<std::size_t>& vertices);

/// The same for the segments of a scan. Neighbouring pieces of a segment share the beam at their vertex. A
/// segment of all beams of a full circle is cut at its first beam and at the beam farthest from that, and its
/// last piece ends with its last beam.
std::vector<ScanSegment> split(const Scan& scan, std::span<const ScanSegment> segments,
                               const SplitConfig& config = {});
void split(const Scan& scan, std::span<const ScanSegment> segments, const SplitConfig& config,
           SplitScratch& scratch, std::vector<ScanSegment>& pieces);

/// The same without segmentation first: only beams that are no hits cut the scan.
std::vector<ScanSegment> split(const Scan& scan, const SplitConfig& config = {});

}  // namespace beaconless
