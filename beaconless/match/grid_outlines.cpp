// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/grid_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "beaconless/features/split.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_moments.hpp"
#include "beaconless/match/cell_loops.hpp"
#include "beaconless/match/thin_walls.hpp"
#include "beaconless/match/walls_once.hpp"

namespace beaconless {
namespace {

constexpr double kMostMoved_cells = 2.5;  // a corner from where its outline was cut
constexpr double kLeastTurn_deg = 15.0;   // flatter corners are not placed well by where lines cross
constexpr double kDrawnShare = 0.8;
constexpr int kLeastLength = 4;      // of a wall, in its thickness; what is shorter has two sides
constexpr double kSmallShare = 0.3;  // of an outline's width: what is no larger is not straightened away

using Points = std::vector<Eigen::Vector2d>;

std::size_t farthest_from(const Points& loop, const Eigen::Vector2d& place) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < loop.size(); ++i)
    if ((loop[i] - place).squaredNorm() > (loop[best] - place).squaredNorm()) best = i;
  return best;
}

/// Turns a loop round to begin at a corner of it, and closes it by that point.
void begin_at_corner(Points& loop) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : loop) sum += point;
  const std::size_t corner = farthest_from(loop, sum / static_cast<double>(loop.size()));
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(corner), loop.end());
  loop.push_back(loop.front());
}

/// A straight piece of a loop.
struct Piece {
  PrincipalLine line;
  std::span<const Eigen::Vector2d> middles;  // of the loop
  std::optional<ThinWall> wall;              // of which it is a part
};

PrincipalLine principal_line_of(const ThinWall& wall) {
  const Eigen::Vector2d along = (wall.at(wall.line.middle + 1.0) - wall.at(wall.line.middle)).normalized();
  PrincipalLine line;
  line.centroid = wall.at(wall.line.middle);
  line.normal = {-along.y(), along.x()};
  line.rho_m = line.normal.dot(line.centroid);
  return line;
}

/// Buffers for the columns of a piece: all, those of the usual thickness, and those near its line.
struct Columns {
  std::vector<WallColumn> all;
  std::vector<WallColumn> usual;
  std::vector<WallColumn> near;
};

/// Whether so many columns are as thick as usual as have to be where a line is drawn; a laser's noise makes
/// them change from one to the next.
bool is_drawn(const ThinWall& wall, const Columns& columns) {
  const auto alike = std::count_if(columns.all.begin(), columns.all.end(),
                                   [&](const WallColumn& column) { return column.cells <= wall.cells + 1; });
  const double rise = std::abs(wall.line.slope);
  const double expected = wall.cells == 1 ? 1.0 - rise : wall.cells == 2 && rise > 0.4 ? rise : 1.0;
  return static_cast<double>(columns.usual.size()) >= kDrawnShare * expected * static_cast<double>(alike);
}

/// The line through the middles of a piece of a loop. Those at its ends belong to two pieces; a piece that is
/// long enough does without.
Piece piece_of(const Points& loop, std::size_t first, std::size_t last, const ThinWalls& thin,
               Columns& columns) {
  const std::size_t spare = last - first >= 6 ? 1 : 0;
  PointMoments sums;
  if (thin.are_looked_at()) {
    const Eigen::Vector2d way = (loop[last] - loop[first]).cwiseAbs();
    const bool is_along_x = way.x() >= way.y();
    columns.all.clear();
    columns.usual.clear();
    std::vector<int> cells;
    for (std::size_t i = first + spare; i <= last - spare; ++i)
      if (const auto column = thin.column_at(loop[i], is_along_x)) {
        if (!columns.all.empty() && columns.all.back().along == column->along) continue;
        columns.all.push_back(*column);
        cells.push_back(column->cells);
      }
    if (!cells.empty()) {
      const auto median = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
      std::nth_element(cells.begin(), median, cells.end());
      const int usual = *median;
      const bool is_longer_than_thick = static_cast<int>(last - first) >= kLeastLength * usual;
      if (is_longer_than_thick) {
        // Where something stands against the wall, its cells are not the wall's.
        std::copy_if(columns.all.begin(), columns.all.end(), std::back_inserter(columns.usual),
                     [&](const WallColumn& column) { return column.cells == usual; });
        auto wall = thin.wall_of(columns.usual, is_along_x, columns.near);
        if (wall && is_drawn(*wall, columns)) return {principal_line_of(*wall), {}, wall};
        for (const WallColumn& column : columns.all)
          if (column.cells <= usual + 1)
            sums.add(is_along_x ? column.along : column.across, is_along_x ? column.across : column.along);
        if (2.0 * sums.count > static_cast<double>(last - first + 1 - 2 * spare))
          return {principal_line(sums), {}, {}};
        sums = {};
      }
    }
  }
  for (std::size_t i = first + spare; i <= last - spare; ++i) sums.add(loop[i].x(), loop[i].y());
  return {principal_line(sums), {}, {}};
}

/// Where two pieces meet: where their lines cross, if that is near and they cross at an angle; else midway
/// between where the lines pass by.
Eigen::Vector2d meeting(const PrincipalLine& before, const PrincipalLine& after, const Eigen::Vector2d& cut) {
  const auto corner = crossing(before, after, std::sin(radians(kLeastTurn_deg)));
  if (corner && (*corner - cut).norm() <= kMostMoved_cells) return *corner;
  return cut -
         0.5 * (before.signed_distance_m(cut) * before.normal + after.signed_distance_m(cut) * after.normal);
}

/// An outline in cells: corners, the first again at the end, and the pieces between them.
struct Outline {
  Points corners;
  std::vector<Piece> pieces;
};

Outline straightened(Points& loop, double straight_cells, const ThinWalls& thin, SplitScratch& scratch) {
  Outline outline;
  if (loop.size() == 1) {
    const Eigen::Vector2d& at = loop.front();
    const Eigen::Vector2d x(0.5, 0.0);
    const Eigen::Vector2d y(0.0, 0.5);
    outline.corners = {at + x, at + y, at - x, at - y, at + x};
    outline.pieces.resize(4);
    for (Piece& piece : outline.pieces) piece.middles = loop;
    return outline;
  }
  begin_at_corner(loop);
  const double width = (loop[farthest_from(loop, loop.front())] - loop.front()).norm();
  std::vector<std::size_t> cuts;
  split(loop, {.epsilon_m = std::min(straight_cells, kSmallShare * width)}, scratch, cuts);
  Columns columns;
  std::vector<Piece>& pieces = outline.pieces;
  pieces.reserve(cuts.size());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    pieces.push_back(piece_of(loop, cuts[i - 1], cuts[i], thin, columns));
    pieces.back().middles = std::span(loop).subspan(cuts[i - 1], cuts[i] - cuts[i - 1] + 1);
  }
  Points& corners = outline.corners;
  corners.reserve(cuts.size() + 1);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    corners.push_back(meeting(pieces[i > 0 ? i - 1 : pieces.size() - 1].line, pieces[i].line, loop[cuts[i]]));
  corners.push_back(corners.front());
  return outline;
}

}  // namespace

void describe(Fields& fields, GridOutlinesConfig& config) {
  fields("straight_cells", config.straight_cells, {0.5, 100.0},
         "by how many cells those of a straight wall may stray from a line");
  fields("straight_least_m", config.straight_least_m, {0.0, 1.0}, "… and by how much in a fine grid");
}

FloorPlan outlines_of(const OccupancyGrid& grid, const GridOutlinesConfig& config) {
  const double straight_cells = std::max(config.straight_cells, config.straight_least_m / grid.resolution_m);
  const ThinWalls thin(grid, config.thin_cells);
  FloorPlan plan;
  WallsOnce once(thin);
  SplitScratch scratch;
  Points loop;
  for (const std::vector<Cell>& cells : find_cell_loops(grid)) {
    loop.clear();
    for (const Cell& cell : cells) loop.emplace_back(cell.x + 0.5, cell.y + 0.5);
    Outline outline = straightened(loop, straight_cells, thin, scratch);
    if (thin.are_looked_at())
      for (std::size_t i = 0; i < outline.pieces.size(); ++i)
        once.add({outline.corners[i], outline.corners[i + 1]}, outline.pieces[i].middles,
                 outline.pieces[i].wall);
    else
      plan.walls.push_back(std::move(outline.corners));
  }
  if (thin.are_looked_at()) {
    plan.cell_m = grid.resolution_m;
    plan.cells_rad = grid.map_from_grid.theta_rad;
    for (const Segment2& wall : once.walls()) plan.walls.push_back({wall.a, wall.b});
  }
  for (FloorPlan::Polyline& wall : plan.walls)
    for (Eigen::Vector2d& corner : wall) corner = grid.map_from_grid * (grid.resolution_m * corner);
  return plan;
}

}  // namespace beaconless
