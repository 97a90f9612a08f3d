// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/grid_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/map/grid_traversal.hpp"

namespace beaconless {
namespace {

constexpr double kUnit = 1024.0;  ///< steps of one log-odds
constexpr double kMaxCoordinate_m = 1e6;
constexpr int kMargin_cells = 256;  ///< room left when growing, and a quarter of the size on top

int logit(double p) { return static_cast<int>(std::lround(kUnit * std::log(p / (1.0 - p)))); }

std::int8_t percent_of(int log_odds) {
  return static_cast<std::int8_t>(std::lround(100.0 / (1.0 + std::exp(-log_odds / kUnit))));
}

}  // namespace

void describe(Fields& fields, GridBuilderConfig& config) {
  fields("resolution_m", config.resolution_m, {0.001, 10.0}, "side of a cell");
  fields("p_occupied", config.p_occupied, {0.51, 0.999},
         "probability that a cell is occupied where a beam ended");
  fields("p_free", config.p_free, {0.001, 0.49},
         "probability that a cell is occupied where a beam went through");
  fields("min_log_odds", config.min_log_odds, {-31.0, -0.1}, "how sure a cell can be of being free");
  fields("max_log_odds", config.max_log_odds, {0.1, 31.0}, "how sure a cell can be of being occupied");
  fields("max_range_m", config.max_range_m, {0.1, 1000.0}, "hits beyond it only free the way up to it");
  fields("no_return_free_m", config.no_return_free_m, {0.0, 1000.0},
         "beams without return free the way up to here; 0: they say nothing");
}

Result<GridBuilder> GridBuilder::make(const GridBuilderConfig& config) {
  if (const auto checked = check_config(config); !checked) return checked.error();
  GridBuilder builder;
  builder.config_ = config;
  builder.hit_ = logit(config.p_occupied);
  builder.miss_ = logit(config.p_free);
  builder.low_ = static_cast<int>(std::lround(kUnit * config.min_log_odds));
  builder.high_ = static_cast<int>(std::lround(kUnit * config.max_log_odds));
  return builder;
}

Result<Done> GridBuilder::add(const Scan& scan, const Pose2& map_from_laser) {
  const Eigen::Vector2d laser = map_from_laser.translation();
  if (!map_from_laser.is_finite() || laser.cwiseAbs().maxCoeff() > kMaxCoordinate_m)
    return Error{"map_from_laser", "the pose is not finite or beyond 1e6 m",
                 "check the poses that go with the scans"};
  const std::vector<Way> ways = ways_of(scan, map_from_laser);
  if (ways.empty()) return Done{};

  const Eigen::Vector2d start_cells = laser / config_.resolution_m;
  Box needed{cell_of(start_cells), cell_of(start_cells)};
  for (const Way& way : ways) {
    const Cell end = cell_of(way.end_cells);
    needed.low = {std::min(needed.low.x, end.x), std::min(needed.low.y, end.y)};
    needed.high = {std::max(needed.high.x, end.x), std::max(needed.high.y, end.y)};
  }
  needed.high = {needed.high.x + 1, needed.high.y + 1};
  if (auto grown = grow_to(needed); !grown) return grown;

  begin_scan();
  const auto occupied = static_cast<std::uint16_t>(mark_ + 1);
  for (const Way& way : ways)
    if (way.hit) update(cell_of(way.end_cells), hit_, occupied);
  for (const Way& way : ways)
    traverse_cells(start_cells, way.end_cells, [&](Cell cell) { update(cell, miss_, mark_); });
  return Done{};
}

std::vector<GridBuilder::Way> GridBuilder::ways_of(const Scan& scan, const Pose2& map_from_laser) const {
  const double no_return_m = std::min({config_.no_return_free_m, config_.max_range_m, scan.range_max_m()});
  std::vector<Way> ways;
  ways.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    Eigen::Vector2d end;
    bool hit = false;
    if (scan.is_hit(beam)) {
      hit = scan.ranges_m()[beam] <= config_.max_range_m;
      end = hit ? scan.point(beam) : Eigen::Vector2d(config_.max_range_m * scan.direction(beam));
    } else if (scan.beams()[beam] == Beam::no_return && no_return_m > 0.0) {
      end = no_return_m * scan.direction(beam);
    } else {
      continue;
    }
    ways.push_back({map_from_laser * end / config_.resolution_m, hit});
  }
  return ways;
}

Result<Done> GridBuilder::grow_to(const Box& needed) {
  Box box = cells_.empty()
                ? needed
                : Box{{std::min(box_.low.x, needed.low.x), std::min(box_.low.y, needed.low.y)},
                      {std::max(box_.high.x, needed.high.x), std::max(box_.high.y, needed.high.y)}};
  if (box.cells() > kMaxCells)
    return Error{"GridBuilder",
                 "the grid would have " + std::to_string(box.width()) + " x " + std::to_string(box.height()) +
                     " cells",
                 "at most " + std::to_string(kMaxCells) + " in all: raise resolution_m or check the poses"};
  if (!cells_.empty() && box.low == box_.low && box.high == box_.high) return Done{};

  // Room to spare on the sides that moved, so that a long drive copies the grid only a few times.
  const int spare_x = kMargin_cells + static_cast<int>(box.width() / 4);
  const int spare_y = kMargin_cells + static_cast<int>(box.height() / 4);
  Box roomy = box;
  if (cells_.empty() || box.low.x < box_.low.x) roomy.low.x -= spare_x;
  if (cells_.empty() || box.low.y < box_.low.y) roomy.low.y -= spare_y;
  if (cells_.empty() || box.high.x > box_.high.x) roomy.high.x += spare_x;
  if (cells_.empty() || box.high.y > box_.high.y) roomy.high.y += spare_y;
  if (roomy.cells() <= kMaxCells) box = roomy;

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

void GridBuilder::begin_scan() {
  constexpr int kLastMark = std::numeric_limits<std::uint16_t>::max() - 3;
  if (mark_ >= kLastMark) {
    for (CellState& cell : cells_) cell.mark = std::min<std::uint16_t>(cell.mark, 1);
    mark_ = 1;
  }
  mark_ = static_cast<std::uint16_t>(mark_ + 2);
}

GridBuilder::CellState& GridBuilder::at(Cell cell) {
  const std::int64_t row = std::int64_t{cell.y} - box_.low.y;
  return cells_[static_cast<std::size_t>(row * box_.width() + (cell.x - box_.low.x))];
}

void GridBuilder::update(Cell cell, int log_odds, std::uint16_t mark) {
  CellState& state = at(cell);
  if (state.mark >= mark) return;
  state.log_odds = static_cast<std::int16_t>(std::clamp(state.log_odds + log_odds, low_, high_));
  state.mark = mark;
}

OccupancyGrid GridBuilder::grid() const {
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
  grid.resolution_m = config_.resolution_m;
  if (cells_.empty()) return grid;
  grid.map_from_grid = {seen.low.x * config_.resolution_m, seen.low.y * config_.resolution_m, 0.0};
  grid.width_cells = static_cast<int>(seen.width());
  grid.height_cells = static_cast<int>(seen.height());
  grid.occupancy_percent.reserve(static_cast<std::size_t>(seen.cells()));
  for (int y = seen.low.y; y < seen.high.y; ++y) {
    for (int x = seen.low.x; x < seen.high.x; ++x) {
      const std::int64_t row = std::int64_t{y} - box_.low.y;
      const CellState& state = cells_[static_cast<std::size_t>(row * box_.width() + (x - box_.low.x))];
      grid.occupancy_percent.push_back(state.mark == 0 ? OccupancyGrid::kUnknown
                                                       : percent_of(state.log_odds));
    }
  }
  return grid;
}

}  // namespace beaconless
