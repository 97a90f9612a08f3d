// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/result.hpp"
#include "beaconless/map/beam_ways.hpp"
#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// What a beam says about the cells it meets, and how sure a cell can become.
struct LogOddsModel {
  double p_occupied = 0.9;     ///< that a cell is occupied where a beam ended
  double p_free = 0.3;         ///< that a cell is occupied where a beam went through
  double min_log_odds = -7.0;  ///< p = 0.001; a cell that changes is learnt anew in bounded time
  double max_log_odds = 7.0;   ///< p = 0.999
};

/// Cells that gather what beams say about them: for an obstacle where beams end, against one on the way.
///
/// A scan updates a cell once, and ends win over ways. The grid grows as needed. Rows run along the map's
/// axes; cell (0, 0) has its lower left corner in the map's origin, and cells may be negative. Source:
/// log-odds l += logit(p), Moravec and Elfes 1985; dissertation, Algorithm 8 and what follows it; one update
/// of a cell a scan: Kohlbrecher et al. 2011 (HectorSLAM). Differs: exact traversal (Amanatides and Woo) in
/// place of Bresenham, which skips cells; log-odds are counted in 1/1024, so that the order of the scans does
/// not matter (while no cell is at a limit) and the same bits come twice; they have limits on both sides,
/// where hector_slam has one for obstacles only and free cells take ever longer to learn of a new wall.
class LogOddsGrid {
 public:
  /// In: probabilities and limits as GridBuilderConfig allows them; never more than `max_cells`.
  LogOddsGrid(double resolution_m, const LogOddsModel& model, std::int64_t max_cells);

  /// Makes room for the beams of a scan. In, errors and cost: as for add().
  Result<Done> cover(const Eigen::Vector2d& laser_map, std::span<const BeamWay> ways);

  /// Takes in the beams of one scan. In: finite points within 1e9 cells.
  ///
  /// Errors, and then nothing is changed: more than max_cells. Cost: the cells under the beams; growing
  /// copies the grid.
  Result<Done> add(const Eigen::Vector2d& laser_map, std::span<const BeamWay> ways) {
    return add(laser_map, ways, [](Cell, int, int) {});
  }

  /// Also calls `on_change(Cell, log-odds before, log-odds now)` for each cell that was updated, once; a cell
  /// seen for the first time had 0.
  template <class OnChange>
  Result<Done> add(const Eigen::Vector2d& laser_map, std::span<const BeamWay> ways, OnChange&& on_change) {
    if (ways.empty()) return Done{};
    if (auto room = cover(laser_map, ways); !room) return room;
    begin_scan();
    const auto update = [&](Cell cell, int evidence, std::uint16_t mark) {
      CellState& state = at(cell);
      if (state.mark >= mark) return;
      const int before = state.log_odds;
      state.log_odds = static_cast<std::int16_t>(std::clamp(before + evidence, low_, high_));
      state.mark = mark;
      on_change(cell, before, static_cast<int>(state.log_odds));
    };
    const auto occupied = static_cast<std::uint16_t>(mark_ + 1);
    for (const BeamWay& way : ways)
      if (way.hit) update(cell_of(way.end_map / resolution_m_), hit_, occupied);
    const Eigen::Vector2d start_cells = laser_map / resolution_m_;
    for (const BeamWay& way : ways)
      traverse_cells(start_cells, way.end_map / resolution_m_,
                     [&](Cell cell) { update(cell, miss_, mark_); });
    return Done{};
  }

  /// What is known so far, cropped to the cells that were seen. Percent are rounded probabilities; cells
  /// never seen are unknown. Empty before the first scan.
  OccupancyGrid grid() const;

  double resolution_m() const { return resolution_m_; }
  static double probability(int log_odds);  ///< of log-odds as on_change gives them

  /// The cells that have room: from `low` (in) to `high` (out).
  struct Box {
    Cell low;
    Cell high;

    std::int64_t width() const { return std::int64_t{high.x} - low.x; }
    std::int64_t height() const { return std::int64_t{high.y} - low.y; }
    std::int64_t cells() const { return width() * height(); }
    friend bool operator==(const Box&, const Box&) = default;
  };
  const Box& room() const { return box_; }

 private:
  /// Log-odds in 1/1024, and the last scan that touched the cell: 0 for never, see mark_ below.
  struct CellState {
    std::int16_t log_odds = 0;
    std::uint16_t mark = 0;
  };

  Result<Done> grow_to(const Box& needed);
  void begin_scan();
  CellState& at(Cell cell) { return cells_[place(cell)]; }
  std::size_t place(Cell cell) const {
    return static_cast<std::size_t>((std::int64_t{cell.y} - box_.low.y) * box_.width() +
                                    (cell.x - box_.low.x));
  }

  double resolution_m_;
  std::int64_t max_cells_;
  int hit_;   ///< what a hit adds, in 1/1024
  int miss_;  ///< what a way through adds
  int low_;
  int high_;
  std::uint16_t mark_ = 1;  ///< of the free cells of this scan; its occupied cells have mark_ + 1
  Box box_;
  std::vector<CellState> cells_;
};

}  // namespace beaconless
