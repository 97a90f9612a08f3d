// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/thin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace beaconless::report {
namespace {

/// What one column of pixels keeps.
struct Column {
  bool has_value = false;
  std::size_t missing = 0;
  std::size_t first = 0;
  std::size_t lowest = 0;
  std::size_t highest = 0;
  std::size_t last = 0;

  void add(std::size_t i, std::span<const double> y) {
    if (!std::isfinite(y[i])) {
      missing = i;
      return;
    }
    if (!has_value) first = lowest = highest = i;
    has_value = true;
    last = i;
    if (y[i] < y[lowest]) lowest = i;
    if (y[i] > y[highest]) highest = i;
  }

  void append_to(std::vector<std::size_t>& kept) const {
    if (!has_value) {
      kept.push_back(missing);
      return;
    }
    std::array<std::size_t, 4> four{first, lowest, highest, last};
    std::sort(four.begin(), four.end());
    kept.insert(kept.end(), four.begin(), std::unique(four.begin(), four.end()));
  }
};

}  // namespace

std::vector<std::size_t> thin(std::span<const double> x, std::span<const double> y, std::size_t columns) {
  const std::size_t count = std::min(x.size(), y.size());
  if (count <= 4 * columns || columns == 0) {
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  const double width = x[count - 1] - x[0];
  const auto column_of = [&](std::size_t i) {
    const double at = width > 0.0 ? (x[i] - x[0]) / width * static_cast<double>(columns) : 0.0;
    return std::min(columns - 1, static_cast<std::size_t>(std::max(at, 0.0)));
  };
  std::vector<std::size_t> kept;
  Column column;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && column_of(i) != column_of(i - 1)) {
      column.append_to(kept);
      column = {};
    }
    column.add(i, y);
  }
  column.append_to(kept);
  return kept;
}

}  // namespace beaconless::report
