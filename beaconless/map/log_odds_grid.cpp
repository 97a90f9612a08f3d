// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/log_odds_grid.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace beaconless {
namespace {

constexpr double kUnit = 1024.0;    ///< steps of one log-odds
constexpr int kMargin_cells = 256;  ///< room left when growing, and a quarter of the size on top

int steps(double log_odds) { return static_cast<int>(std::lround(kUnit * log_odds)); }
int logit(double p) { return steps(std::log(p / (1.0 - p))); }

std::int8_t percent_of(int log_odds) {
  return static_cast<std::int8_t>(std::lround(100.0 * LogOddsGrid::probability(log_odds)));
}

}  // namespace

LogOddsGrid::LogOddsGrid(double resolution_m, const LogOddsModel& model, std::int64_t max_cells)
    : resolution_m_(resolution_m),
      max_cells_(max_cells),
      hit_(logit(model.p_occupied)),
      miss_(logit(model.p_free)),
      low_(steps(model.min_log_odds)),
      high_(steps(model.max_log_odds)) {}

double LogOddsGrid::probability(int log_odds) { return 1.0 / (1.0 + std::exp(-log_odds / kUnit)); }

Result<Done> LogOddsGrid::cover(const Eigen::Vector2d& laser_map, std::span<const BeamWay> ways) {
  const Cell start = cell_of(laser_map / resolution_m_);
  Box needed{start, start};
  for (const BeamWay& way : ways) {
    const Cell end = cell_of(way.end_map / resolution_m_);
    needed.low = {std::min(needed.low.x, end.x), std::min(needed.low.y, end.y)};
    needed.high = {std::max(needed.high.x, end.x), std::max(needed.high.y, end.y)};
  }
  needed.high = {needed.high.x + 1, needed.high.y + 1};
  return grow_to(needed);
}

Result<Done> LogOddsGrid::grow_to(const Box& needed) {
  Box box = cells_.empty()
                ? needed
                : Box{{std::min(box_.low.x, needed.low.x), std::min(box_.low.y, needed.low.y)},
                      {std::max(box_.high.x, needed.high.x), std::max(box_.high.y, needed.high.y)}};
  if (!cells_.empty() && box == box_) return Done{};
  if (box.cells() > max_cells_)
    return Error{
        "grid",
        "it would have " + std::to_string(box.width()) + " x " + std::to_string(box.height()) + " cells",
        "at most " + std::to_string(max_cells_) + " in all: raise resolution_m or check the poses"};

  // Room to spare on the sides that moved, so that a long drive copies the grid only a few times.
  const int spare_x = kMargin_cells + static_cast<int>(box.width() / 4);
  const int spare_y = kMargin_cells + static_cast<int>(box.height() / 4);
  Box roomy = box;
  if (cells_.empty() || box.low.x < box_.low.x) roomy.low.x -= spare_x;
  if (cells_.empty() || box.low.y < box_.low.y) roomy.low.y -= spare_y;
  if (cells_.empty() || box.high.x > box_.high.x) roomy.high.x += spare_x;
  if (cells_.empty() || box.high.y > box_.high.y) roomy.high.y += spare_y;
  if (roomy.cells() <= max_cells_) box = roomy;

  std::vector<CellState> cells(static_cast<std::size_t>(box.cells()));
  for (int y = box_.low.y; y < box_.high.y; ++y) {
    const auto from = cells_.begin() + (std::int64_t{y} - box_.low.y) * box_.width();
    std::copy(from, from + box_.width(),
              cells.begin() + (std::int64_t{y} - box.low.y) * box.width() + (box_.low.x - box.low.x));
  }
  cells_ = std::move(cells);
  box_ = box;
  return Done{};
}

void LogOddsGrid::begin_scan() {
  constexpr int kLastMark = std::numeric_limits<std::uint16_t>::max() - 3;
  if (mark_ >= kLastMark) {
    for (CellState& cell : cells_) cell.mark = std::min<std::uint16_t>(cell.mark, 1);
    mark_ = 1;
  }
  mark_ = static_cast<std::uint16_t>(mark_ + 2);
}

OccupancyGrid LogOddsGrid::grid() const {
  Box seen{box_.high, box_.low};
  std::size_t i = 0;
  for (int y = box_.low.y; y < box_.high.y; ++y) {
    for (int x = box_.low.x; x < box_.high.x; ++x, ++i) {
      if (cells_[i].mark == 0) continue;
      seen.low = {std::min(seen.low.x, x), std::min(seen.low.y, y)};
      seen.high = {std::max(seen.high.x, x + 1), std::max(seen.high.y, y + 1)};
    }
  }
  OccupancyGrid grid;
  grid.resolution_m = resolution_m_;
  if (seen.width() <= 0) return grid;
  grid.map_from_grid = {seen.low.x * resolution_m_, seen.low.y * resolution_m_, 0.0};
  grid.width_cells = static_cast<int>(seen.width());
  grid.height_cells = static_cast<int>(seen.height());
  grid.occupancy_percent.reserve(static_cast<std::size_t>(seen.cells()));
  for (int y = seen.low.y; y < seen.high.y; ++y) {
    for (int x = seen.low.x; x < seen.high.x; ++x) {
      const CellState& state = cells_[place({x, y})];
      grid.occupancy_percent.push_back(state.mark == 0 ? OccupancyGrid::kUnknown
                                                       : percent_of(state.log_odds));
    }
  }
  return grid;
}

}  // namespace beaconless
