// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// The points of a scan as plain arrays in which every segment is contiguous.
///
/// An open scan is viewed as it is: places are beams. A full circle is copied so that the first segment
/// stands a little behind the beginning and everything stands once more a turn further on.
struct OrderedPoints {
  std::span<const float> x_m;
  std::span<const float> y_m;
  std::span<const float> ranges_m;  ///< 0 where not a hit
  std::size_t beam_count = 0;
  std::size_t first_beam = 0;   ///< the beam at place 0
  std::size_t first_place = 0;  ///< of the first segment
  bool is_circle = false;

  std::size_t size() const { return x_m.size(); }
  Eigen::Vector2d operator[](std::size_t place) const { return {x_m[place], y_m[place]}; }
  bool is_hit(std::size_t place) const { return ranges_m[place] > 0.0F; }

  std::size_t beam_at(std::size_t place) const {
    return is_circle ? (first_beam + place) % beam_count : place;
  }

  ScanSegment segment_of(std::size_t first, std::size_t last) const {
    return {beam_at(first), last - first + 1};
  }

  /// Where a segment's first beam stands; segments in their order stand at ascending places.
  std::size_t place_of(const ScanSegment& segment) const {
    if (!is_circle) return segment.first;
    const std::size_t head = (first_beam + first_place) % beam_count;
    return first_place + (segment.first + beam_count - head) % beam_count;
  }
};

/// The places from `first` to `last`, both included.
struct PlaceRun {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Buffers that live on from scan to scan.
struct OrderedPointsScratch {
  std::vector<float> x_m;
  std::vector<float> y_m;
  std::vector<float> ranges_m;
};

/// Views or copies the scan, whose segments are in the order of their first beams. Cost: of a full circle,
/// two copies of the ranges and points.
OrderedPoints ordered_points(const Scan& scan, std::span<const ScanSegment> segments,
                             OrderedPointsScratch& scratch);

}  // namespace beaconless
