// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_curvature.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

constexpr std::size_t kLongestLink = 3;  // to the next point, over one, over two

/// Where a point lies among the cells.
struct Place {
  std::size_t cell;  // at or before it
  float share;       // of the next cell
};

Place place_of(float cells) {
  const auto cell = static_cast<std::size_t>(cells);
  return {cell, cells - static_cast<float>(cell)};
}

void share_out(const Place& place, float value, std::vector<float>& cells) {
  cells[place.cell] += (1.0F - place.share) * value;
  cells[place.cell + 1] += place.share * value;
}

float at(const Place& place, const std::vector<float>& cells) {
  return cells[place.cell] + place.share * (cells[place.cell + 1] - cells[place.cell]);
}

}  // namespace

void measure_contour(const FlirtContour& contour, double longest_m, CurvatureScratch& scratch) {
  const auto most_m = static_cast<float>(longest_m);
  scratch.along_m.resize(contour.size());
  for (const FlirtStretch& stretch : contour.stretches) {
    scratch.along_m[stretch.begin] = 0.0F;
    for (std::size_t i = stretch.begin + 1; i < stretch.end; ++i) {
      float shortest_m = 0.0F;
      for (std::size_t link = 1; link <= kLongestLink && stretch.begin + link <= i; ++link) {
        const float dx = contour.x_m[i] - contour.x_m[i - link];
        const float dy = contour.y_m[i] - contour.y_m[i - link];
        const float length_m = std::sqrt(dx * dx + dy * dy);
        const float way_m = scratch.along_m[i - link] + std::min(length_m, most_m);
        // What was cut short is no way to leave points out.
        if (link == 1 || (length_m < most_m && way_m < shortest_m)) shortest_m = way_m;
      }
      scratch.along_m[i] = shortest_m;
    }
  }
}

void contour_moves(const FlirtContour& contour, const FlirtStretch& stretch, double sigma_m,
                   const ScaleKernel& kernel, CurvatureScratch& s, std::span<float> move_x_m,
                   std::span<float> move_y_m) {
  if (stretch.size() == 0) return;
  const auto points_begin = s.along_m.begin() + static_cast<std::ptrdiff_t>(stretch.begin);
  const auto points_end = s.along_m.begin() + static_cast<std::ptrdiff_t>(stretch.end);
  const float length_m = *std::max_element(points_begin, points_end);
  const auto cells_per_m = static_cast<float>(kCellsPerSigma / sigma_m);

  // 1. Cells along the stretch, with empty ones around it as far as the kernel reaches.
  const std::size_t around = kernel.half_width();
  const std::size_t count = static_cast<std::size_t>(length_m * cells_per_m) + 2 * around + 2;
  for (auto* cells : {&s.weight, &s.x, &s.y}) cells->assign(count, 0.0F);
  for (auto* cells : {&s.smooth_weight, &s.smooth_x, &s.smooth_y}) cells->resize(count);
  const auto place = [&](std::size_t i) {
    return place_of(s.along_m[i] * cells_per_m + static_cast<float>(around));
  };

  // 2. How dense the points are.
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) share_out(place(i), 1.0F, s.weight);
  smooth_signal(s.weight, kernel, s.padded, s.smooth_weight);

  // 3. The points, each as heavy as it is lonely, smoothed.
  s.weight.assign(count, 0.0F);
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const Place here = place(i);
    const float weight = 1.0F / at(here, s.smooth_weight);
    share_out(here, weight, s.weight);
    share_out(here, weight * contour.x_m[i], s.x);
    share_out(here, weight * contour.y_m[i], s.y);
  }
  smooth_signal(s.weight, kernel, s.padded, s.smooth_weight);
  smooth_signal(s.x, kernel, s.padded, s.smooth_x);
  smooth_signal(s.y, kernel, s.padded, s.smooth_y);

  // 4. From each point to its average.
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const Place here = place(i);
    const float whole = at(here, s.smooth_weight);
    move_x_m[i] = at(here, s.smooth_x) / whole - contour.x_m[i];
    move_y_m[i] = at(here, s.smooth_y) / whole - contour.y_m[i];
  }
}

}  // namespace beaconless
