// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/walls_once.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/map/wall_index.hpp"

namespace beaconless {
namespace {

constexpr double kSame_cells = 0.5;       // a piece this near to a longer one all along is a part of it …
constexpr double kPastEnd_cells = 1.5;    // … if it ends so far past that at most
constexpr double kMostMoved_cells = 2.5;  // an end, to where the wall meets another
constexpr double kGrazed_cells = 0.1;     // a cell this near to a wall may be the wall's
constexpr double kMostPassed = 0.75;      // share of a thin wall's columns that longer ones pass through too
constexpr double kAllPassed = 0.95;       // … of the cells of what is no thin wall
constexpr double kDoubt = 3.0;            // how little a wall's columns count where they stray
constexpr double kTile_cells = 4.0;

bool lies_on(const WallIndex::Wall& piece, const WallIndex::Wall& wall) {
  for (const double at : {0.0, piece.length_m}) {
    const Eigen::Vector2d from = piece.a + at * piece.along - wall.a;
    const double along = wall.along.dot(from);
    const double across = wall.along.x() * from.y() - wall.along.y() * from.x();
    if (std::abs(across) > kSame_cells || along < -kPastEnd_cells || along > wall.length_m + kPastEnd_cells)
      return false;
  }
  return true;
}

/// A wall from where its columns or the corners of the piece end, whichever is further.
Segment2 between_ends(const ThinWall& wall, const Segment2& piece) {
  double from = wall.from;
  double to = wall.to;
  for (const Eigen::Vector2d& end : {piece.a, piece.b}) {
    const double along = wall.is_along_x ? end.x() : end.y();
    if (along > wall.from - kMostMoved_cells) from = std::min(from, along);
    if (along < wall.to + kMostMoved_cells) to = std::max(to, along);
  }
  return {wall.at(from), wall.at(to)};
}

/// Which cells of a grid walls have been seen to pass through.
class Passed {
 public:
  explicit Passed(const OccupancyGrid& grid)
      : grid_(grid), is_passed_(grid.occupancy_percent.size(), false) {}

  bool at(const Cell& cell) const { return grid_.contains(cell) && is_passed_[grid_.index(cell)]; }

  /// The share of a wall's columns whose middle has been passed.
  double share_of(const ThinWall& wall) const {
    double passed = 0.0;
    double all = 0.0;
    for (double along = wall.from; along <= wall.to; along += 1.0, all += 1.0)
      if (at(cell_of(wall.at(along)))) passed += 1.0;
    return passed / all;
  }
  /// … of cells; those at the ends belong to two pieces.
  double share_of(std::span<const Eigen::Vector2d> middles) const {
    if (middles.size() > 4) middles = middles.subspan(1, middles.size() - 2);
    const auto passed = std::count_if(middles.begin(), middles.end(),
                                      [&](const Eigen::Vector2d& middle) { return at(cell_of(middle)); });
    return static_cast<double>(passed) / static_cast<double>(middles.size());
  }

  void add(const ThinWall& wall) {
    const double rise = std::abs(wall.line.slope);
    const double half = 0.5 * std::max(rise, wall.cells - 1.0) + kGrazed_cells;
    for (double along = wall.from - 1.0; along <= wall.to + 1.0; along += 1.0) {
      const double middle = wall.line.across_at(along);
      const int column = static_cast<int>(std::floor(along));
      for (int across = static_cast<int>(std::floor(middle - half)); across <= std::floor(middle + half);
           ++across) {
        const Cell cell = wall.is_along_x ? Cell{column, across} : Cell{across, column};
        if (grid_.contains(cell)) is_passed_[grid_.index(cell)] = true;
      }
    }
  }

 private:
  static Cell cell_of(const Eigen::Vector2d& point) {
    return {static_cast<int>(std::floor(point.x())), static_cast<int>(std::floor(point.y()))};
  }

  const OccupancyGrid& grid_;
  std::vector<bool> is_passed_;
};

/// The pieces without those that lie on a longer one.
std::vector<Segment2> without_parts(const std::vector<Segment2>& pieces) {
  FloorPlan plan;
  for (const Segment2& piece : pieces) plan.walls.push_back({piece.a, piece.b});
  const WallIndex index(plan, kTile_cells, kTile_cells);
  std::vector<Segment2> once;
  for (std::uint32_t id = 0; id < index.wall_count(); ++id) {
    const WallIndex::Wall& piece = index.wall(id);
    const auto others = index.near(piece.a + 0.5 * piece.length_m * piece.along);
    const bool is_part = std::any_of(others.begin(), others.end(), [&](std::uint32_t other) {
      const WallIndex::Wall& wall = index.wall(other);
      const bool is_longer =
          wall.length_m > piece.length_m || (wall.length_m == piece.length_m && other < id);
      return other != id && is_longer && lies_on(piece, wall);
    });
    if (!is_part) once.push_back({piece.a, piece.a + piece.length_m * piece.along});
  }
  return once;
}

}  // namespace

void WallsOnce::add(const Segment2& piece, std::span<const Eigen::Vector2d> middles,
                    const std::optional<ThinWall>& wall) {
  if (wall) {
    const ThinWall whole = thin_.whole(*wall);
    wholes_.push_back({whole, between_ends(whole, piece)});
  } else {
    others_.push_back({piece, {middles.begin(), middles.end()}});
  }
}

std::vector<Segment2> WallsOnce::walls() const {
  // What leads through cells of several walls may be longer than each, but has fewer columns of its own.
  std::vector<const Whole*> surest_first;
  surest_first.reserve(wholes_.size());
  for (const Whole& whole : wholes_) surest_first.push_back(&whole);
  const auto sureness = [](const ThinWall& wall) {
    return static_cast<double>(wall.columns) * (1.0 - kDoubt * wall.line.slack);
  };
  std::stable_sort(surest_first.begin(), surest_first.end(),
                   [&](const Whole* p, const Whole* q) { return sureness(p->wall) > sureness(q->wall); });
  Passed passed(thin_.grid());
  std::vector<Segment2> pieces;
  for (const Whole* whole : surest_first) {
    if (passed.share_of(whole->wall) > kMostPassed) continue;
    passed.add(whole->wall);
    pieces.push_back(whole->between);
  }
  for (const Other& other : others_)
    if (passed.share_of(other.middles) <= kAllPassed) pieces.push_back(other.piece);
  return without_parts(pieces);
}

}  // namespace beaconless
