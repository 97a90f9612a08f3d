// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/features/beam_neighbourhoods.hpp"

namespace beaconless {

/// Whether the outermost neighbours of a hit span a triangle with it whose base and height are both at least
/// `share` of the radius: what corners do and straight walls do not.
///
/// Source: Kallasi et al. 2016, section III-A, with share = 1 / beta.
inline bool is_triangle(const BeamNeighbourhoods& around, std::size_t centre, float share) {
  const UnrolledScan& points = around.points;
  const std::uint32_t first = around.first[centre];
  const std::uint32_t last = around.last[centre];
  const float first_x = points.x_m[first] - points.x_m[centre];
  const float first_y = points.y_m[first] - points.y_m[centre];
  const float last_x = points.x_m[last] - points.x_m[centre];
  const float last_y = points.y_m[last] - points.y_m[centre];
  const float least = around.radius_m[centre] * share;
  const float base_squared =
      (last_x - first_x) * (last_x - first_x) + (last_y - first_y) * (last_y - first_y);
  const float twice_area = first_x * last_y - first_y * last_x;
  return base_squared >= least * least && twice_area * twice_area >= least * least * base_squared;
}

}  // namespace beaconless
