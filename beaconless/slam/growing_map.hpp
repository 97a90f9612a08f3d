// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/map/beam_ways.hpp"
#include "beaconless/map/log_odds_grid.hpp"
#include "beaconless/map/occupancy_pyramid.hpp"

namespace beaconless {

/// How a map grows out of scans.
struct GrowingMapConfig {
  double resolution_m = 0.05;   ///< of the finest level
  int levels = 3;               ///< each half as fine as the one before
  double p_occupied = 0.9;      ///< that a cell is occupied where a beam ended; Hector's
  double p_free = 0.4;          ///< … where a beam went through; Hector's (dissertation: 0.3)
  double min_log_odds = -4.0;   ///< p = 0.018
  double max_log_odds = 6.0;    ///< p = 0.998
  int max_cells = 100'000'000;  ///< of the finest level, 500 x 500 m at 5 cm; each takes 8 bytes
};

void describe(Fields& fields, GrowingMapConfig& config);

/// A pyramid of grids made on the way: every level gathers the evidence of the same scans for itself, and is
/// ready to be matched with.
///
/// Coarse levels are not thinned from finer ones: a coarse cell is occupied by a scan that ends in it,
/// whatever other beams of the scan pass through, and so keeps thin walls. M of a cell is 2 p - 1, see
/// OccupancyLevel::value_of(). Source: Kohlbrecher et al., SSRR 2011; dissertation 3.3.2 for the evidence.
/// Differs: see LogOddsGrid and OccupancyLevel.
class GrowingMap {
 public:
  explicit GrowingMap(const GrowingMapConfig& config);

  /// Takes in the beams of one scan. In: finite points within 1e6 m.
  ///
  /// Errors, and then nothing is changed: more than max_cells. Cost: the cells under the beams, on each
  /// level; allocates only to grow.
  Result<Done> add(const Eigen::Vector2d& laser_map, std::span<const BeamWay> ways);

  bool empty() const { return scan_count_ == 0; }
  std::size_t scan_count() const { return scan_count_; }
  const OccupancyPyramid& pyramid() const { return pyramid_; }

  /// The finest level as a map of its own.
  OccupancyGrid grid() const { return evidence_.front().grid(); }

 private:
  std::vector<LogOddsGrid> evidence_;  ///< finest first, like pyramid_.levels
  OccupancyPyramid pyramid_;
  std::size_t scan_count_ = 0;
};

}  // namespace beaconless
