// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/features/flirt_contour.hpp"
#include "beaconless/features/flirt_kernel.hpp"

namespace beaconless {

/// Buffers of wall_directions().
struct NormalScratch {
  std::vector<float> smooth_range;
  std::vector<double> x, y, xx, xy, yy;  ///< sums of the points before the one that the index names
  std::vector<float> numerator, denominator;
  std::vector<float> behind;  ///< below 0 where the fitted normal points at the sensor
  std::vector<float> padded;
};

/// The direction of the wall's normal at each point of a contour, away from the sensor, in radians.
///
/// Ranges are smoothed with `kernel`, then a line is fitted to `window_beams` points about each (fewer at the
/// ends of a stretch). Along a stretch the direction is unwrapped: no step exceeds pi. Cost: O(1) a point
/// whatever the window, by prefix sums; accurate to 1e-5 rad where points are 1 mm apart at 30 m.
///
/// Source: total least squares, dissertation 2.1.2; arctangent: Abramowitz and Stegun 4.4.49 (2e-8 rad),
/// since the library's own is ten times slower than all the rest.
void wall_directions(const FlirtContour& contour, const ScaleKernel& kernel, std::size_t window_beams,
                     NormalScratch& scratch, std::vector<float>& direction_rad);

/// The direction away from the sensor of the normal of the line through contour points [begin, end).
double support_direction(const FlirtContour& contour, std::size_t begin, std::size_t end);

}  // namespace beaconless
