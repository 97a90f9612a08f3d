// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace beaconless::report {

/// A mark on an axis.
struct Tick {
  double at = 0.0;
  std::string label;

  friend bool operator==(const Tick&, const Tick&) = default;
};

/// A stretch of numbers to be drawn along, with its round marks in ascending order.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;
  std::vector<Tick> ticks;

  /// 0 at `low`, 1 at `high`. Values that a logarithmic axis cannot show lie at 0; NaN stays NaN.
  double fraction(double value) const;
};

/// Marks at multiples of 1, 2 or 5 times a power of ten, about `count` of them.
///
/// `snug` keeps the ends where they are; else they move out to the next mark. Ends that are equal, not finite
/// or in the wrong order give an axis that holds what there is.
Axis linear_axis(double low, double high, int count = 6, bool snug = false);

/// Marks at powers of ten (and at 2 and 5 times them on less than three decades); at most nine decades below
/// `high`.
Axis log_axis(double low, double high);

/// The largest of 1, 2, 5 times a power of ten that is not above `value`; 1 for what is not positive.
double round_below(double value);

}  // namespace beaconless::report
