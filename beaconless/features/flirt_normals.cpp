// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_normals.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr auto kPi_f = static_cast<float>(kPi);
constexpr auto kHalfPi_f = static_cast<float>(0.5 * kPi);

/// atan2 without branches, so that a loop over it becomes vector code; 0 at the origin.
float arctangent(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float greater = std::max(ax, ay);
  const float ratio = std::min(ax, ay) / (greater > 0.0F ? greater : 1.0F);
  const float s = ratio * ratio;
  float sum = 0.0028662257F;
  sum = sum * s - 0.0161657367F;
  sum = sum * s + 0.0429096138F;
  sum = sum * s - 0.0752896400F;
  sum = sum * s + 0.1065626393F;
  sum = sum * s - 0.1420889944F;
  sum = sum * s + 0.1999355085F;
  sum = sum * s - 0.3333314528F;
  float angle = ratio + ratio * s * sum;
  angle = ay > ax ? kHalfPi_f - angle : angle;
  angle = x < 0.0F ? kPi_f - angle : angle;
  return std::copysign(angle, y);
}

/// The sums of a window of points about their mean, times their number.
struct Moments {
  double count = 0.0;
  double x = 0.0, y = 0.0;  // sums
  double xx = 0.0, xy = 0.0, yy = 0.0;

  double numerator() const { return -2.0 * (count * xy - x * y); }
  double denominator() const { return (count * yy - y * y) - (count * xx - x * x); }
};

/// Whether the normal at half the angle (denominator, numerator), in [-pi/2, pi/2], points at the sensor: the
/// sign of its product with the mean, written with the half-angle formula that does not cancel.
double outward(const Moments& m, double numerator, double denominator) {
  const double length = std::sqrt(numerator * numerator + denominator * denominator);
  const double flat = m.x * (length + denominator) + m.y * numerator;
  const double steep = std::copysign(1.0, numerator) * (m.x * numerator + m.y * (length - denominator));
  return denominator >= 0.0 ? flat : steep;
}

void make_sums(const FlirtContour& contour, NormalScratch& scratch) {
  const std::size_t size = contour.size();
  for (auto* sums : {&scratch.x, &scratch.y, &scratch.xx, &scratch.xy, &scratch.yy}) {
    sums->resize(size + 1);
    sums->front() = 0.0;
  }
  for (std::size_t i = 0; i < size; ++i) {
    const double stretched = static_cast<double>(scratch.smooth_range[i]) / contour.range_m[i];
    const double x = stretched * contour.x_m[i];
    const double y = stretched * contour.y_m[i];
    scratch.x[i + 1] = scratch.x[i] + x;
    scratch.y[i + 1] = scratch.y[i] + y;
    scratch.xx[i + 1] = scratch.xx[i] + x * x;
    scratch.xy[i + 1] = scratch.xy[i] + x * y;
    scratch.yy[i + 1] = scratch.yy[i] + y * y;
  }
}

void fit(std::size_t point, std::size_t begin, std::size_t end, NormalScratch& s) {
  const Moments m{static_cast<double>(end - begin), s.x[end] - s.x[begin],   s.y[end] - s.y[begin],
                  s.xx[end] - s.xx[begin],          s.xy[end] - s.xy[begin], s.yy[end] - s.yy[begin]};
  const double numerator = m.numerator();
  const double denominator = m.denominator();
  s.numerator[point] = static_cast<float>(numerator);
  s.denominator[point] = static_cast<float>(denominator);
  s.behind[point] = static_cast<float>(outward(m, numerator, denominator));
}

void fit_stretch(const FlirtStretch& stretch, std::size_t half, NormalScratch& scratch) {
  const std::size_t inner_begin = std::min(stretch.begin + half, stretch.end);
  const std::size_t inner_end = stretch.end > inner_begin + half ? stretch.end - half : inner_begin;
  const auto clipped = [&](std::size_t i) {
    fit(i, i > stretch.begin + half ? i - half : stretch.begin, std::min(i + half + 1, stretch.end), scratch);
  };
  for (std::size_t i = stretch.begin; i < inner_begin; ++i) clipped(i);
  for (std::size_t i = inner_begin; i < inner_end; ++i) fit(i, i - half, i + half + 1, scratch);
  for (std::size_t i = inner_end; i < stretch.end; ++i) clipped(i);
}

void unwrap(const FlirtStretch& stretch, std::span<float> direction_rad) {
  constexpr auto kTurn_f = static_cast<float>(2.0 * kPi);
  float turns = 0.0F;
  float before = stretch.size() == 0 ? 0.0F : direction_rad[stretch.begin];
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const float here = direction_rad[i];
    const float step = here - before;
    turns += static_cast<float>(static_cast<int>(step < -kPi_f) - static_cast<int>(step >= kPi_f));
    before = here;
    direction_rad[i] = here + turns * kTurn_f;
  }
}

}  // namespace

void wall_directions(const FlirtContour& contour, const ScaleKernel& kernel, std::size_t window_beams,
                     NormalScratch& scratch, std::vector<float>& direction_rad) {
  const std::size_t size = contour.size();
  scratch.smooth_range.resize(size);
  scratch.numerator.resize(size);
  scratch.denominator.resize(size);
  scratch.behind.resize(size);
  direction_rad.resize(size);

  // 1. Smooth the ranges, each stretch for itself.
  for (const FlirtStretch& stretch : contour.stretches)
    smooth_signal(std::span(contour.range_m).subspan(stretch.begin, stretch.size()), kernel, scratch.padded,
                  std::span(scratch.smooth_range).subspan(stretch.begin, stretch.size()));

  // 2. Fit a line to every window: twice the normal's angle as numerator and denominator.
  make_sums(contour, scratch);
  for (const FlirtStretch& stretch : contour.stretches) fit_stretch(stretch, window_beams / 2, scratch);

  // 3. Angles, away from the sensor.
  for (std::size_t i = 0; i < size; ++i) {
    const float angle = 0.5F * arctangent(scratch.numerator[i], scratch.denominator[i]);
    const float opposite = angle > 0.0F ? angle - kPi_f : angle + kPi_f;
    direction_rad[i] = scratch.behind[i] < 0.0F ? opposite : angle;
  }

  // 4. No jumps by a turn.
  for (const FlirtStretch& stretch : contour.stretches) unwrap(stretch, direction_rad);
}

double support_direction(const FlirtContour& contour, std::size_t begin, std::size_t end) {
  Moments m{.count = static_cast<double>(end - begin)};
  if (begin >= end) return 0.0;
  const double x0 = contour.x_m[begin];  // sums about a point of their own do not cancel
  const double y0 = contour.y_m[begin];
  for (std::size_t i = begin; i < end; ++i) {
    const double x = contour.x_m[i] - x0;
    const double y = contour.y_m[i] - y0;
    m.x += x;
    m.y += y;
    m.xx += x * x;
    m.xy += x * y;
    m.yy += y * y;
  }
  const double angle = 0.5 * std::atan2(m.numerator(), m.denominator());
  const double along = (m.x + m.count * x0) * std::cos(angle) + (m.y + m.count * y0) * std::sin(angle);
  return wrap_angle(along < 0.0 ? angle + kPi : angle);
}

}  // namespace beaconless
