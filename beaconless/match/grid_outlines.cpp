// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/grid_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "beaconless/features/split.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_moments.hpp"
#include "beaconless/match/cell_loops.hpp"

namespace beaconless {
namespace {

constexpr double kMostMoved_cells = 2.5;  // a corner from where its outline was cut
constexpr double kLeastTurn_deg = 15.0;   // flatter corners are not placed well by where lines cross
constexpr double kSmallShare = 0.3;       // of an outline's width: what is no larger is not straightened away

using Points = std::vector<Eigen::Vector2d>;

/// Where a wall a few cells thick has its middle.
class Thickness {
 public:
  Thickness(const OccupancyGrid& grid, int most_cells) : grid_(grid), most_cells_(most_cells) {}

  /// In: the middle of an outline's cell, and whether the wall runs along x. Out: the same, moved across the
  /// wall to the middle of its cells by their occupancy; not moved where the wall is thicker than walls are.
  Eigen::Vector2d middle(const Eigen::Vector2d& at, bool is_along_x) const {
    if (most_cells_ < 2) return at;
    const Cell cell{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
    double weight = 0.0;
    double moved = 0.0;
    int cells = 0;
    const auto add = [&](int by) {
      const Cell next = is_along_x ? Cell{cell.x, cell.y + by} : Cell{cell.x + by, cell.y};
      if (!grid_.is_occupied(next)) return false;
      weight += grid_.at(next);
      moved += static_cast<double>(grid_.at(next)) * by;
      ++cells;
      return true;
    };
    for (int by = 0; by <= most_cells_ && add(by); ++by) {
    }
    for (int by = -1; by >= -most_cells_ && add(by); --by) {
    }
    if (cells == 0 || cells > most_cells_) return at;
    moved /= weight;
    return is_along_x ? Eigen::Vector2d(at.x(), at.y() + moved) : Eigen::Vector2d(at.x() + moved, at.y());
  }

 private:
  const OccupancyGrid& grid_;
  int most_cells_;
};

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

/// The line through the middles of a piece of a loop. Those at its ends belong to two pieces; a piece that is
/// long enough does without.
PrincipalLine line_of(const Points& loop, std::size_t first, std::size_t last, const Thickness& thickness) {
  const std::size_t spare = last - first >= 6 ? 1 : 0;
  const Eigen::Vector2d way = (loop[last] - loop[first]).cwiseAbs();
  PointMoments sums;
  for (std::size_t i = first + spare; i <= last - spare; ++i) {
    const Eigen::Vector2d at = thickness.middle(loop[i], way.x() >= way.y());
    sums.add(at.x(), at.y());
  }
  return principal_line(sums);
}

/// Where two pieces meet: where their lines cross, if that is near and they cross at an angle; else midway
/// between where the lines pass by.
Eigen::Vector2d meeting(const PrincipalLine& before, const PrincipalLine& after, const Eigen::Vector2d& cut) {
  const auto corner = crossing(before, after, std::sin(radians(kLeastTurn_deg)));
  if (corner && (*corner - cut).norm() <= kMostMoved_cells) return *corner;
  return cut -
         0.5 * (before.signed_distance_m(cut) * before.normal + after.signed_distance_m(cut) * after.normal);
}

/// An outline's corners in cells; the first is there again at the end.
Points straightened(Points& loop, double straight_cells, const Thickness& thickness, SplitScratch& scratch) {
  if (loop.size() == 1) {
    const Eigen::Vector2d& at = loop.front();
    const Eigen::Vector2d x(0.5, 0.0);
    const Eigen::Vector2d y(0.0, 0.5);
    return {at + x, at + y, at - x, at - y, at + x};
  }
  begin_at_corner(loop);
  const double width = (loop[farthest_from(loop, loop.front())] - loop.front()).norm();
  std::vector<std::size_t> cuts;
  split(loop, {.epsilon_m = std::min(straight_cells, kSmallShare * width)}, scratch, cuts);
  std::vector<PrincipalLine> lines;
  lines.reserve(cuts.size());
  for (std::size_t i = 1; i < cuts.size(); ++i)
    lines.push_back(line_of(loop, cuts[i - 1], cuts[i], thickness));
  Points corners;
  corners.reserve(cuts.size() + 1);
  for (std::size_t i = 0; i < lines.size(); ++i)
    corners.push_back(meeting(lines[i > 0 ? i - 1 : lines.size() - 1], lines[i], loop[cuts[i]]));
  corners.push_back(corners.front());
  return corners;
}

}  // namespace

void describe(Fields& fields, GridOutlinesConfig& config) {
  fields("straight_cells", config.straight_cells, {0.5, 100.0},
         "by how many cells those of a straight wall may stray from a line");
  fields("straight_least_m", config.straight_least_m, {0.0, 1.0}, "… and by how much in a fine grid");
}

FloorPlan outlines_of(const OccupancyGrid& grid, const GridOutlinesConfig& config) {
  const double straight_cells = std::max(config.straight_cells, config.straight_least_m / grid.resolution_m);
  const Thickness thickness(grid, config.thin_cells);
  FloorPlan plan;
  SplitScratch scratch;
  Points loop;
  for (const std::vector<Cell>& cells : find_cell_loops(grid)) {
    loop.clear();
    for (const Cell& cell : cells) loop.emplace_back(cell.x + 0.5, cell.y + 0.5);
    Points corners = straightened(loop, straight_cells, thickness, scratch);
    for (Eigen::Vector2d& corner : corners) corner = grid.map_from_grid * (grid.resolution_m * corner);
    plan.walls.push_back(std::move(corners));
  }
  return plan;
}

}  // namespace beaconless
