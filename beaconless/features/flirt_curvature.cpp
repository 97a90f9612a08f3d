// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_curvature.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

/// Between the values before and at `at`.
float between(std::span<const float> values, float at) {
  const auto below = std::min(static_cast<std::size_t>(std::max(at, 0.0F)), values.size() - 1);
  const auto above = std::min(below + 1, values.size() - 1);
  const float share = at - static_cast<float>(below);
  return values[below] + share * (values[above] - values[below]);
}

/// The contour at every multiple of `spacing_m` from the beginning of the stretch, and at its end.
void sample(const FlirtContour& contour, const FlirtStretch& stretch, float spacing_m,
            CurvatureScratch& scratch) {
  const std::span along_m(scratch.along_m);
  const float length_m = along_m[stretch.end - 1];
  const auto count = static_cast<std::size_t>(length_m / spacing_m) + 2;
  scratch.x.resize(count);
  scratch.y.resize(count);
  std::size_t i = stretch.begin;
  for (std::size_t k = 0; k < count; ++k) {
    const float at_m = std::min(static_cast<float>(k) * spacing_m, length_m);
    while (i + 2 < stretch.end && along_m[i + 1] < at_m) ++i;
    const std::size_t next = std::min(i + 1, stretch.end - 1);
    const float gap_m = along_m[next] - along_m[i];
    const float share = gap_m > 0.0F ? (at_m - along_m[i]) / gap_m : 0.0F;
    scratch.x[k] = contour.x_m[i] + share * (contour.x_m[next] - contour.x_m[i]);
    scratch.y[k] = contour.y_m[i] + share * (contour.y_m[next] - contour.y_m[i]);
  }
}

}  // namespace

void measure_contour(const FlirtContour& contour, CurvatureScratch& scratch) {
  scratch.along_m.resize(contour.size());
  for (const FlirtStretch& stretch : contour.stretches) {
    float along_m = 0.0F;
    for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
      if (i > stretch.begin) {
        const float dx = contour.x_m[i] - contour.x_m[i - 1];
        const float dy = contour.y_m[i] - contour.y_m[i - 1];
        along_m += std::sqrt(dx * dx + dy * dy);
      }
      scratch.along_m[i] = along_m;
    }
  }
}

void contour_moves(const FlirtContour& contour, const FlirtStretch& stretch, double sigma_m,
                   const ScaleKernel& kernel, CurvatureScratch& scratch, std::span<float> move_x_m,
                   std::span<float> move_y_m) {
  if (stretch.size() == 0) return;
  // 1. Even samples along the stretch.
  const auto spacing_m = static_cast<float>(sigma_m / kSamplesPerSigma);
  sample(contour, stretch, spacing_m, scratch);

  // 2. Smooth both coordinates.
  scratch.smooth_x.resize(scratch.x.size());
  scratch.smooth_y.resize(scratch.y.size());
  smooth_signal(scratch.x, kernel, scratch.padded, scratch.smooth_x);
  smooth_signal(scratch.y, kernel, scratch.padded, scratch.smooth_y);

  // 3. Back to the points.
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const float at = scratch.along_m[i] / spacing_m;
    move_x_m[i] = between(scratch.smooth_x, at) - contour.x_m[i];
    move_y_m[i] = between(scratch.smooth_y, at) - contour.y_m[i];
  }
}

}  // namespace beaconless
