// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_support.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {

FlirtSupport support_of(const FlirtStretch& stretch, std::size_t point, double reach_beams) {
  const auto reach = static_cast<std::size_t>(std::max(1.0, std::ceil(reach_beams)));
  return {point > stretch.begin + reach ? point - reach : stretch.begin,
          std::min(point + reach + 1, stretch.end)};
}

std::size_t nearer_neighbour(const FlirtContour& contour, const FlirtStretch& stretch, std::size_t point) {
  const float here = contour.range_m[point];
  const float before = point > stretch.begin ? contour.range_m[point - 1] : here;
  const float behind = point + 1 < stretch.end ? contour.range_m[point + 1] : here;
  if (before < behind) return before < here ? point - 1 : point;
  return behind < here ? point + 1 : point;
}

std::size_t near_side(const FlirtContour& contour, const FlirtSupport& support, std::size_t point,
                      double min_step_m) {
  auto greatest_m = static_cast<float>(min_step_m);
  std::size_t near = point;
  for (std::size_t i = support.begin; i + 1 < support.end; ++i) {
    const float step_m = contour.range_m[i + 1] - contour.range_m[i];
    if (!(std::abs(step_m) > greatest_m)) continue;
    greatest_m = std::abs(step_m);
    near = step_m > 0.0F ? i : i + 1;
  }
  return near;
}

}  // namespace beaconless
