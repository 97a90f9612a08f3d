// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/thin_walls.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

constexpr double kNear_cells = 0.75;   // a column's middle from where the wall is expected
constexpr double kAside_cells = 0.25;  // a wall's cell from where it is expected
constexpr int kMostMissing = 1;        // columns in a row without a cell of the wall
constexpr int kMostRounds = 6;

}  // namespace

std::optional<WallColumn> ThinWalls::column_at(const Eigen::Vector2d& point, bool is_along_x) const {
  const int along = static_cast<int>(std::floor(is_along_x ? point.x() : point.y()));
  const int across = static_cast<int>(std::floor(is_along_x ? point.y() : point.x()));
  double weight = 0.0;
  double moved = 0.0;
  int cells = 0;
  const auto add = [&](int by) {
    const Cell cell = is_along_x ? Cell{along, across + by} : Cell{across + by, along};
    if (!grid_.is_occupied(cell)) return false;
    weight += grid_.at(cell);
    moved += static_cast<double>(grid_.at(cell)) * by;
    ++cells;
    return true;
  };
  for (int by = 0; by <= most_cells_ && add(by); ++by) {
  }
  if (cells == 0) return std::nullopt;
  for (int by = -1; by >= -most_cells_ && add(by); --by) {
  }
  if (cells > most_cells_) return std::nullopt;
  return WallColumn{along + 0.5, across + 0.5 + moved / weight, cells};
}

std::optional<ThinWall> ThinWalls::wall_of(const std::vector<WallColumn>& columns, bool is_along_x,
                                           std::vector<WallColumn>& near) const {
  const auto line = drawn_line_of_most(columns, near);
  if (!line) return std::nullopt;
  ThinWall wall;
  wall.line = *line;
  wall.cells = near.front().cells;
  wall.is_along_x = is_along_x;
  wall.columns = near.size();
  const auto [first, last] = std::minmax_element(
      near.begin(), near.end(), [](const WallColumn& p, const WallColumn& q) { return p.along < q.along; });
  wall.from = first->along;
  wall.to = last->along;
  return wall;
}

void ThinWalls::collect(const ThinWall& wall, std::vector<WallColumn>& columns) const {
  columns.clear();
  const auto look = [&](double along) {
    const double expected = wall.line.across_at(along);
    const int column = static_cast<int>(std::floor(along));
    int across = static_cast<int>(std::floor(expected));
    if (!is_occupied(column, across, wall.is_along_x)) {
      across = static_cast<int>(
          std::floor(expected - across < 0.5 ? expected - kAside_cells : expected + kAside_cells));
      if (!is_occupied(column, across, wall.is_along_x)) return false;
    }
    const Eigen::Vector2d at =
        wall.is_along_x ? Eigen::Vector2d(along, across + 0.5) : Eigen::Vector2d(across + 0.5, along);
    const auto seen = column_at(at, wall.is_along_x);
    if (seen && seen->cells == wall.cells && std::abs(seen->across - expected) <= kNear_cells)
      columns.push_back(*seen);
    return true;
  };
  int missing = 0;
  for (double along = wall.from; missing <= kMostMissing; along -= 1.0)
    missing = look(along) ? 0 : missing + 1;
  std::reverse(columns.begin(), columns.end());
  missing = 0;
  for (double along = wall.from + 1.0; along <= wall.to || missing <= kMostMissing; along += 1.0)
    missing = look(along) ? 0 : missing + 1;
}

ThinWall ThinWalls::whole(ThinWall wall) const {
  std::vector<WallColumn> columns;
  std::vector<WallColumn> near;
  for (int round = 0; round < kMostRounds; ++round) {
    collect(wall, columns);
    const auto grown = wall_of(columns, wall.is_along_x, near);
    // What is won at the price of more slack is the wall next to it.
    if (!grown || grown->line.slack > wall.line.slack || grown->to - grown->from <= wall.to - wall.from)
      break;
    wall = *grown;
  }
  return wall;
}

}  // namespace beaconless
