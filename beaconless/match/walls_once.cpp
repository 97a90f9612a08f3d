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

}  // namespace

void WallsOnce::add(const Segment2& piece, const std::optional<ThinWall>& wall) {
  pieces_.push_back(wall ? between_ends(thin_.whole(*wall), piece) : piece);
}

std::vector<Segment2> WallsOnce::walls() const {
  FloorPlan plan;
  for (const Segment2& piece : pieces_) plan.walls.push_back({piece.a, piece.b});
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

}  // namespace beaconless
