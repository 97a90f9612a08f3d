// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/eval/association.hpp"

namespace beaconless::eval {

/// What a column of the dissertation's tables says about many errors, and two words more; all 0 for none.
///
/// rmse² = mean² + sd²: sd is that of the population. p95 lies between two errors as far as 95 % falls
/// between them.
struct Statistics {
  double mean = 0.0;
  double rmse = 0.0;
  double sd = 0.0;
  double max = 0.0;
  double min = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  std::size_t count = 0;

  friend bool operator==(const Statistics&, const Statistics&) = default;
};

/// Cost: O(n log n).
Statistics statistics_of(std::vector<double> values);

/// The error of one estimate: estimate minus reference.
struct PoseError {
  Stamp stamp;
  Pose2 estimate;
  Pose2 reference;
  double x_m = 0.0;  ///< along the map's axes
  double y_m = 0.0;
  double along_m = 0.0;      ///< the same, ahead of the reference
  double across_m = 0.0;     ///< and to its left
  double heading_rad = 0.0;  ///< in [-pi, pi)

  double position_m() const;

  friend bool operator==(const PoseError&, const PoseError&) = default;
};

std::vector<PoseError> errors_of(std::span<const PosePair> pairs);

/// The dissertation's two tables: distances, and absolute differences of heading.
/// Source: dissertation 4.4.1, Tables 4.3 and 4.4. Differs: median and p95 are added.
struct ErrorTable {
  Statistics position_m;
  Statistics heading_deg;

  friend bool operator==(const ErrorTable&, const ErrorTable&) = default;
};

ErrorTable table_of(std::span<const PoseError> errors);

}  // namespace beaconless::eval
