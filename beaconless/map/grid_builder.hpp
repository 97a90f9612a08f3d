// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
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
/// Source: log-odds update l += logit(p), Moravec and Elfes 1985; dissertation, Algorithm 8 and what follows
/// it. One update of a cell a scan, with ends winning over ways: Kohlbrecher et al. 2011 (HectorSLAM).
/// Differs: exact traversal (Amanatides and Woo) in place of Bresenham, which skips cells; log-odds are
/// counted in 1/1024, so that the order of the scans does not matter (while no cell is at a limit) and the
/// same bits come twice.
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
  OccupancyGrid grid() const;

  static constexpr std::int64_t kMaxCells = 400'000'000;

 private:
  /// Log-odds in 1/1024, and the last scan that touched the cell: 0 for never, see mark_ below.
  struct CellState {
    std::int16_t log_odds = 0;
    std::uint16_t mark = 0;
  };
  /// Cells from `low` (in) to `high` (out), counted from the map's origin.
  struct Box {
    Cell low;
    Cell high;

    std::int64_t width() const { return std::int64_t{high.x} - low.x; }
    std::int64_t height() const { return std::int64_t{high.y} - low.y; }
    std::int64_t cells() const { return width() * height(); }
  };
  /// One beam on the grid: the point up to which its way is free, and whether something stands there.
  struct Way {
    Eigen::Vector2d end_cells;
    bool hit;
  };

  GridBuilder() = default;

  std::vector<Way> ways_of(const Scan& scan, const Pose2& map_from_laser) const;
  Result<Done> grow_to(const Box& needed);
  void begin_scan();
  CellState& at(Cell cell);
  void update(Cell cell, int log_odds, std::uint16_t mark);

  GridBuilderConfig config_;
  int hit_ = 0;   ///< what a hit adds, in 1/1024
  int miss_ = 0;  ///< what a way through adds
  int low_ = 0;
  int high_ = 0;
  std::uint16_t mark_ = 1;  ///< of the free cells of this scan; its occupied cells have mark_ + 1
  Box box_;
  std::vector<CellState> cells_;
};

}  // namespace beaconless
