// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace beaconless::report {

/// The points that are enough to draw a curve `columns` pixels wide: in each column its first, lowest,
/// highest and last.
///
/// In: x ascending and finite, y of the same length, NaN where something is missing. Out: positions,
/// ascending; at most four a column, and all of them when that would be no fewer. A column without any finite
/// y keeps one that is missing, so that gaps stay. The curve looks the same because a column's vertical
/// extent does. Cost: O(n). Source: the min-max aggregation M4 of Jugel et al., "M4: a visualization-oriented
/// time series data aggregation", VLDB 2014.
std::vector<std::size_t> thin(std::span<const double> x, std::span<const double> y, std::size_t columns);

}  // namespace beaconless::report
