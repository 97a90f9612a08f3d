// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "beaconless/features/flirt_contour.hpp"

namespace beaconless {

/// The points of a contour around a peak: [begin, end), within one stretch.
struct FlirtSupport {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The points up to `reach_beams` (rounded up, at least 1) before and behind a point.
FlirtSupport support_of(const FlirtStretch& stretch, std::size_t point, double reach_beams);

/// The point's nearer neighbour, if that is nearer to the sensor than itself.
/// Source: Tipaldi and Arras 2010, III-A.
std::size_t nearer_neighbour(const FlirtContour& contour, const FlirtStretch& stretch, std::size_t point);

/// The near side of the greatest step between neighbours within the support; the point itself where none is
/// greater than `min_step_m`.
///
/// A near surface ends at the same place for every viewer, while what is behind it is cut off elsewhere from
/// elsewhere. Differs from nearer_neighbour(): coarse peaks lie a sigma from their step, where the next beam
/// belongs to the far surface, too.
std::size_t near_side(const FlirtContour& contour, const FlirtSupport& support, std::size_t point,
                      double min_step_m);

}  // namespace beaconless
