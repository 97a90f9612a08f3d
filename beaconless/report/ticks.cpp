// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "beaconless/core/parse.hpp"

namespace beaconless::report {
namespace {

constexpr double kFarthest = 1e15;
constexpr double kNarrowest_ratio =
    1e-9;  // of the value: less than that, and marks would run into each other
constexpr int kMostDecades = 9;

/// 10^exponent, the nearest double to it; pow() of some libraries is one unit off.
double power_of_ten(int exponent) { return parse_double(fmt::format("1e{}", exponent)).value_or(0.0); }

struct Step {
  int digit = 1;  ///< 1, 2 or 5
  int exponent = 0;

  /// Multiples as quotients below 1, so that 3 * 0.1 is 0.3.
  double times(double n) const {
    return exponent < 0 ? n * digit / power_of_ten(-exponent) : n * digit * power_of_ten(exponent);
  }
};

/// The step of 1, 2, 5 times a power of ten that lies nearest above or below `width`, in ratio.
Step nearest_step(double width) {
  const int exponent = static_cast<int>(std::floor(std::log10(width)));
  const double mantissa = width / std::pow(10.0, exponent);
  if (mantissa < std::sqrt(2.0)) return {1, exponent};
  if (mantissa < std::sqrt(10.0)) return {2, exponent};
  if (mantissa < std::sqrt(50.0)) return {5, exponent};
  return {1, exponent + 1};
}

std::string label(double value, int exponent) {
  if (value == 0.0) return "0";
  if (std::abs(value) >= 1e6 || exponent < -6) return fmt::format("{:g}", value);
  return fmt::format("{:.{}f}", value, std::max(0, -exponent));
}

/// Ends that are finite, in order and apart.
std::pair<double, double> settled(double low, double high) {
  if (!std::isfinite(low) && !std::isfinite(high)) return {0.0, 1.0};
  if (!std::isfinite(low)) low = high;
  if (!std::isfinite(high)) high = low;
  low = std::clamp(low, -kFarthest, kFarthest);
  high = std::clamp(high, -kFarthest, kFarthest);
  if (low > high) std::swap(low, high);
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low > kNarrowest_ratio * size && high - low > 1e-300) return {low, high};
  const double around = size > 1e-12 ? 0.1 * size : 1.0;
  return {low - around, high + around};
}

}  // namespace

double Axis::fraction(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  if (std::isnan(value)) return value;
  if (value <= low) return 0.0;
  return std::log(value / low) / std::log(high / low);
}

Axis linear_axis(double low, double high, int count, bool snug) {
  std::tie(low, high) = settled(low, high);
  const Step step = nearest_step((high - low) / std::max(count, 1));
  const double width = step.times(1.0);
  // A hundredth of a step of tolerance keeps an end that is a mark, but for rounding, where it is.
  const double first = snug ? std::ceil(low / width - 0.01) : std::floor(low / width + 0.01);
  const double last = snug ? std::floor(high / width + 0.01) : std::ceil(high / width - 0.01);
  Axis axis{snug ? low : step.times(first), snug ? high : step.times(last), false, {}};
  for (double n = first; n <= last; n += 1.0) {
    const double at = n == 0.0 ? 0.0 : step.times(n);
    axis.ticks.push_back({at, label(at, step.exponent)});
  }
  return axis;
}

Axis log_axis(double low, double high) {
  if (!std::isfinite(high) || high <= 0.0) high = 1.0;
  if (!std::isfinite(low) || low <= 0.0) low = 0.1 * high;
  high = std::clamp(high, 1e-14, kFarthest);
  const int top = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
  int bottom = static_cast<int>(std::floor(std::log10(std::clamp(low, 1e-300, high)) + 1e-9));
  bottom = std::clamp(bottom, top - kMostDecades, top - 1);
  Axis axis{power_of_ten(bottom), power_of_ten(top), true, {}};
  const bool between = top - bottom < 3;
  const int stride = top - bottom > 6 ? 2 : 1;
  for (int exponent = bottom; exponent <= top; exponent += stride)
    for (const int digit : {1, 2, 5}) {
      if (digit > 1 && (!between || exponent == top)) continue;
      const double at = Step{digit, exponent}.times(1.0);
      axis.ticks.push_back({at, label(at, exponent)});
    }
  return axis;
}

double round_below(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-12));
  for (const int digit : {5, 2})
    if (const double at = Step{digit, exponent}.times(1.0); at <= value * (1.0 + 1e-12)) return at;
  return power_of_ten(exponent);
}

}  // namespace beaconless::report
