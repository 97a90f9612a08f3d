// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/log_odds_grid.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// How scans become a grid.
struct GridBuilderConfig {
  double resolution_m = 0.05;  ///< side of a cell
  double p_occupied = 0.9;     ///< that a cell is occupied where a beam ended; the dissertation's value
  double p_free = 0.3;         ///< that a cell is occupied where a beam went through; likewise
  double min_log_odds = -7.0;  ///< p = 0.001; a cell that changes is learnt anew in bounded time
  double max_log_odds = 7.0;   ///< p = 0.999
  double max_range_m = 80.0;   ///< hits beyond it are not believed; the way to them is free up to here
  double no_return_free_m =
      0;  ///< beams without return free the way up to here; 0: they say nothing (glass, black)
};

void describe(Fields& fields, GridBuilderConfig& config);

/// Makes an occupancy grid of scans taken at known poses: cells where beams end gather evidence for an
/// obstacle, cells on the way gather evidence against one.
///
/// Source: see LogOddsGrid, which gathers the evidence.
class GridBuilder {
 public:
  /// Errors: a value of the config that is not allowed (see describe).
  static Result<GridBuilder> make(const GridBuilderConfig& config = {});

  /// Takes in one scan. The grid grows as needed.
  ///
  /// Errors, and then nothing is changed: a pose that is not finite or beyond 1e6 m, a grid of more than
  /// kMaxCells. Cost: the cells under the beams; growing copies the grid.
  Result<Done> add(const Scan& scan, const Pose2& map_from_laser);

  /// What is known so far, cropped to the cells that were seen; its lower left corner is a whole number of
  /// cells from the map's origin. Percent are rounded probabilities; cells never seen are unknown. Empty
  /// before the first scan.
  OccupancyGrid grid() const { return cells_.grid(); }

  static constexpr std::int64_t kMaxCells = 400'000'000;

 private:
  GridBuilder(const GridBuilderConfig& config, const LogOddsModel& model)
      : config_(config), cells_(config.resolution_m, model, kMaxCells) {}

  GridBuilderConfig config_;
  LogOddsGrid cells_;
  std::vector<BeamWay> ways_;  ///< of the last scan
};

}  // namespace beaconless
