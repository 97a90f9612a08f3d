// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/grid_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "beaconless/features/split.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_moments.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/cell_loops.hpp"

namespace beaconless {
namespace {

constexpr double kMostMoved_cells = 2.5;   // a corner from where its outline was cut
constexpr double kLeastTurn_deg = 15.0;    // flatter corners are not placed well by where lines cross
constexpr std::size_t kLeastDrawn = 5;     // cells that tell a line
constexpr double kSteepest = 1.2;          // slope against the axis that a wall is nearer to
constexpr std::size_t kPicked = 12;        // pairs of these many and one are tried for a line …
constexpr double kNear_cells = 0.75;       // … that passes so near …
constexpr double kMostShare = 0.6;         // … so many of the cells
constexpr int kHalvings = 60;              // of what its slope may be, by a third each
constexpr double kDrawnWidth_cells = 1.3;  // rounding strays by no more
constexpr double kSame_cells = 1.0;        // a piece this near to a longer one all along is a part of it
constexpr double kSmallShare = 0.3;  // of an outline's width: what is no larger is not straightened away

using Points = std::vector<Eigen::Vector2d>;

/// Where a wall a few cells thick has its middle.
class Thickness {
 public:
  Thickness(const OccupancyGrid& grid, int most_cells) : grid_(grid), most_cells_(most_cells) {}

  bool is_looked_at() const { return most_cells_ >= 2; }

  /// In: the middle of an outline's cell, and whether the wall runs along x. Out: the same, moved across the
  /// wall to the middle of its cells by their occupancy; nothing where there are more than a thin wall has.
  struct Across {
    Eigen::Vector2d middle;
    int cells;
  };
  std::optional<Across> across(const Eigen::Vector2d& at, bool is_along_x) const {
    if (most_cells_ < 2) return std::nullopt;
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
    if (cells == 0 || cells > most_cells_) return std::nullopt;
    moved /= weight;
    return Across{at + moved * (is_along_x ? Eigen::Vector2d::UnitY() : Eigen::Vector2d::UnitX()), cells};
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

/// The line whose cells these are, if they are those of one drawn line: the middle of the narrowest strip
/// that holds them. Rounding to cells is no noise to be averaged; every cell that was drawn shuts out lines.
std::optional<PrincipalLine> drawn_line(const Points& middles, bool is_along_x) {
  if (middles.size() < kLeastDrawn) return std::nullopt;
  const int u = is_along_x ? 0 : 1;
  const double from = middles.front()[u];
  double low = 0.0;  // of the line, across
  double high = 0.0;
  const auto width = [&](double slope) {
    low = high = middles.front()[1 - u];
    for (const Eigen::Vector2d& at : middles) {
      const double across = at[1 - u] - slope * (at[u] - from);
      low = std::min(low, across);
      high = std::max(high, across);
    }
    return high - low;
  };
  // The width is convex in the slope.
  double least = -kSteepest;
  double most = kSteepest;
  for (int i = 0; i < kHalvings; ++i) {
    const double third = (most - least) / 3.0;
    if (width(least + third) < width(most - third))
      most -= third;
    else
      least += third;
  }
  const double slope = 0.5 * (least + most);
  if (width(slope) > kDrawnWidth_cells) return std::nullopt;
  PrincipalLine line;
  const double inverse = 1.0 / std::sqrt(1.0 + slope * slope);
  line.normal[u] = -slope * inverse;
  line.normal[1 - u] = inverse;
  line.centroid[u] = from;
  line.centroid[1 - u] = 0.5 * (low + high);
  line.rho_m = line.normal.dot(line.centroid);
  return line;
}

/// The same of most of them: those nearest to the line through two of them that has most near it. The others
/// belong to what stands against the wall, and to the walls next to it.
std::optional<PrincipalLine> drawn_line_of_most(const Points& middles, bool is_along_x, Points& near) {
  if (middles.size() < kLeastDrawn) return std::nullopt;
  const int u = is_along_x ? 0 : 1;
  const auto picked = [&](std::size_t k) -> const Eigen::Vector2d& {
    return middles[k * (middles.size() - 1) / kPicked];
  };
  const auto distance = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& on, double slope) {
    return std::abs(at[1 - u] - on[1 - u] - slope * (at[u] - on[u]));
  };
  std::ptrdiff_t most = 0;
  for (std::size_t first = 0; first < kPicked; ++first)
    for (std::size_t last = first + 1; last <= kPicked; ++last) {
      const Eigen::Vector2d& on = picked(first);
      const double length = picked(last)[u] - on[u];
      if (std::abs(length) < 3.0) continue;
      const double slope = (picked(last)[1 - u] - on[1 - u]) / length;
      const auto is_near = [&](const Eigen::Vector2d& at) { return distance(at, on, slope) < kNear_cells; };
      const auto count = std::count_if(middles.begin(), middles.end(), is_near);
      if (count <= most) continue;
      most = count;
      near.clear();
      std::copy_if(middles.begin(), middles.end(), std::back_inserter(near), is_near);
    }
  if (static_cast<double>(most) < kMostShare * static_cast<double>(middles.size())) return std::nullopt;
  return drawn_line(near, is_along_x);
}

/// The line through the middles of a piece of a loop. Those at its ends belong to two pieces; a piece that is
/// long enough does without.
PrincipalLine line_of(const Points& loop, std::size_t first, std::size_t last, const Thickness& thickness,
                      Points& middles, Points& near) {
  const std::size_t spare = last - first >= 6 ? 1 : 0;
  const Eigen::Vector2d way = (loop[last] - loop[first]).cwiseAbs();
  const bool is_along_x = way.x() >= way.y();
  std::vector<Thickness::Across> seen;
  std::vector<int> cells;
  for (std::size_t i = first + spare; i <= last - spare; ++i) {
    const auto across = thickness.across(loop[i], is_along_x);
    if (!across) continue;
    seen.push_back(*across);
    cells.push_back(across->cells);
  }
  // Where something stands against the wall, its cells are not the wall's.
  middles.clear();
  if (!cells.empty()) {
    const auto median = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
    std::nth_element(cells.begin(), median, cells.end());
    const int usual = *median;
    for (const Thickness::Across& across : seen)
      if (across.cells == usual) middles.push_back(across.middle);
    if (const auto drawn = drawn_line_of_most(middles, is_along_x, near)) return *drawn;
    middles.clear();
    for (const Thickness::Across& across : seen)
      if (across.cells <= usual + 1) middles.push_back(across.middle);
  }
  const bool is_thin = 2 * middles.size() > last - first + 1 - 2 * spare;
  PointMoments sums;
  if (is_thin)
    for (const Eigen::Vector2d& at : middles) sums.add(at.x(), at.y());
  else
    for (std::size_t i = first + spare; i <= last - spare; ++i) sums.add(loop[i].x(), loop[i].y());
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
  Points middles;
  Points near;
  lines.reserve(cuts.size());
  for (std::size_t i = 1; i < cuts.size(); ++i)
    lines.push_back(line_of(loop, cuts[i - 1], cuts[i], thickness, middles, near));
  Points corners;
  corners.reserve(cuts.size() + 1);
  for (std::size_t i = 0; i < lines.size(); ++i)
    corners.push_back(meeting(lines[i > 0 ? i - 1 : lines.size() - 1], lines[i], loop[cuts[i]]));
  corners.push_back(corners.front());
  return corners;
}

/// A plan without the pieces of walls that lie on a longer one: a thin wall's other side, and what is left of
/// it between the things that stand against it.
FloorPlan once_each(const FloorPlan& plan, double near_m) {
  const WallIndex index(plan, 4.0 * near_m, 4.0 * near_m);
  const auto lies_on = [&](const WallIndex::Wall& piece, const WallIndex::Wall& wall) {
    for (const double at : {0.0, piece.length_m}) {
      const Eigen::Vector2d from = piece.a + at * piece.along - wall.a;
      const double along = wall.along.dot(from);
      const double across = wall.along.x() * from.y() - wall.along.y() * from.x();
      if (std::abs(across) > near_m || along < -near_m || along > wall.length_m + near_m) return false;
    }
    return true;
  };
  FloorPlan once;
  once.cell_m = plan.cell_m;
  for (std::uint32_t id = 0; id < index.wall_count(); ++id) {
    const WallIndex::Wall& piece = index.wall(id);
    const Eigen::Vector2d middle = piece.a + 0.5 * piece.length_m * piece.along;
    const auto others = index.near(middle);
    const bool is_there = std::any_of(others.begin(), others.end(), [&](std::uint32_t other) {
      const WallIndex::Wall& wall = index.wall(other);
      const bool is_longer =
          wall.length_m > piece.length_m || (wall.length_m == piece.length_m && other < id);
      return other != id && is_longer && lies_on(piece, wall);
    });
    if (!is_there) once.walls.push_back({piece.a, piece.a + piece.length_m * piece.along});
  }
  return once;
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
  if (thickness.is_looked_at()) plan.cell_m = grid.resolution_m;
  SplitScratch scratch;
  Points loop;
  for (const std::vector<Cell>& cells : find_cell_loops(grid)) {
    loop.clear();
    for (const Cell& cell : cells) loop.emplace_back(cell.x + 0.5, cell.y + 0.5);
    Points corners = straightened(loop, straight_cells, thickness, scratch);
    for (Eigen::Vector2d& corner : corners) corner = grid.map_from_grid * (grid.resolution_m * corner);
    plan.walls.push_back(std::move(corners));
  }
  return thickness.is_looked_at() ? once_each(plan, kSame_cells * grid.resolution_m) : plan;
}

}  // namespace beaconless
