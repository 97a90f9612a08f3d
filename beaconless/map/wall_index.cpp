// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "beaconless/map/wall_tiles.hpp"

namespace beaconless {
namespace {

/// The tiles that cover a plan.
struct Tiling {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  double side_m = 1.0;
  int columns = 0;
  int rows = 0;

  std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t tile(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  int column_of(double x) const { return static_cast<int>(std::floor((x - low.x()) / side_m)); }
  int row_of(double y) const { return static_cast<int>(std::floor((y - low.y()) / side_m)); }
  Eigen::Vector2d center_of(int column, int row) const {
    return low + side_m * Eigen::Vector2d(column + 0.5, row + 0.5);
  }
};

/// Calls visit(column, row) for every tile whose center is within `reach_m` of a wall.
template <class Visit>
void for_tiles_near(const Segment2& wall, double reach_m, const Tiling& tiling, Visit visit) {
  const int y0 = std::max(0, tiling.row_of(std::min(wall.a.y(), wall.b.y()) - reach_m));
  const int y1 = std::min(tiling.rows - 1, tiling.row_of(std::max(wall.a.y(), wall.b.y()) + reach_m));
  const Eigen::Vector2d along = wall.b - wall.a;
  for (int y = y0; y <= y1; ++y) {
    // The part of the wall whose y lies within reach of this row bounds the columns worth looking at.
    double s0 = 0.0;
    double s1 = 1.0;
    if (std::abs(along.y()) > 1e-12) {
      const double middle = tiling.center_of(0, y).y() - wall.a.y();
      const double p = (middle - reach_m) / along.y();
      const double q = (middle + reach_m) / along.y();
      s0 = std::clamp(std::min(p, q), 0.0, 1.0);
      s1 = std::clamp(std::max(p, q), 0.0, 1.0);
    }
    const double xa = wall.a.x() + s0 * along.x();
    const double xb = wall.a.x() + s1 * along.x();
    const int x0 = std::max(0, tiling.column_of(std::min(xa, xb) - reach_m));
    const int x1 = std::min(tiling.columns - 1, tiling.column_of(std::max(xa, xb) + reach_m));
    for (int x = x0; x <= x1; ++x)
      if (wall.distance_m(tiling.center_of(x, y)) <= reach_m) visit(x, y);
  }
}

constexpr int kMostRepeated = 5;    // cells after which a wall comes to the same place in them
constexpr double kMaxVisits = 4e7;  // of tiles by walls, so that no plan takes for ever

Tiling tiling_of(const FloorPlan::Bounds& bounds, const std::vector<Segment2>& walls, double reach_m,
                 double least_side_m) {
  Tiling tiling;
  tiling.low = bounds.low.array() - reach_m;
  const Eigen::Vector2d extent = bounds.high.array() + reach_m - tiling.low.array();
  double visited_m2 = 0.0;
  for (const Segment2& wall : walls) visited_m2 += (wall.length_m() + 2.0 * reach_m) * 2.0 * reach_m;
  tiling.side_m = std::max({least_side_m, std::sqrt(extent.x() * extent.y() / WallIndex::kMaxTiles),
                            std::sqrt(visited_m2 / kMaxVisits)});
  tiling.columns = static_cast<int>(std::ceil(extent.x() / tiling.side_m));
  tiling.rows = static_cast<int>(std::ceil(extent.y() / tiling.side_m));
  return tiling;
}

/// The walls whose distance from the center of a tile is within reach, one tile after the other.
class WallsOfTiles {
 public:
  WallsOfTiles(const std::vector<Segment2>& walls, double reach_m, const Tiling& tiling)
      : ends_(tiling.count() + 1, 0) {
    const auto visit_all = [&](auto visit) {
      for (std::uint32_t i = 0; i < walls.size(); ++i)
        for_tiles_near(walls[i], reach_m, tiling, [&](int x, int y) { visit(tiling.tile(x, y), i); });
    };
    visit_all([&](std::size_t tile, std::uint32_t /*wall*/) { ++ends_[tile + 1]; });
    for (std::size_t tile = 0; tile < tiling.count(); ++tile) ends_[tile + 1] += ends_[tile];
    walls_.resize(ends_.back());
    // While a tile is filled, its entry is where the next wall goes: at last where the tile ends.
    visit_all([&](std::size_t tile, std::uint32_t wall) { walls_[ends_[tile]++] = wall; });
  }

  std::span<const std::uint32_t> of(std::size_t tile) const {
    return {walls_.data() + (tile == 0 ? 0 : ends_[tile - 1]), walls_.data() + ends_[tile]};
  }

 private:
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> walls_;
};

/// The walls without those that are there twice, whichever way round.
std::vector<Segment2> distinct(std::vector<Segment2> walls) {
  const auto before = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  };
  for (Segment2& wall : walls)
    if (before(wall.b, wall.a)) std::swap(wall.a, wall.b);
  std::sort(walls.begin(), walls.end(), [&](const Segment2& p, const Segment2& q) {
    return before(p.a, q.a) || (p.a == q.a && before(p.b, q.b));
  });
  walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  return walls;
}

/// Of where a wall lies across that was read from cells: each of them shuts out lines, so that what is left
/// falls with their number. Where the wall rises by p cells in q, the same places in cells come again, and
/// the 1/q of a cell between them stays: a whole cell along the axes of the grid. Source: Dorst and
/// Smeulders, "Discrete representation of straight lines", 1984.
double variance_of_read(const FloorPlan& plan, const Segment2& wall) {
  if (plan.cell_m <= 0.0) return 0.0;
  const Eigen::Vector2d way = wall.b - wall.a;
  const double along_x = std::abs(std::cos(plan.cells_rad) * way.x() + std::sin(plan.cells_rad) * way.y());
  const double along_y = std::abs(std::cos(plan.cells_rad) * way.y() - std::sin(plan.cells_rad) * way.x());
  const double cells = std::max(along_x, along_y) / plan.cell_m;
  const double slope = std::min(along_x, along_y) / std::max(along_x, along_y);
  double sigma_cells = 1.0 / cells;
  for (int q = kMostRepeated; q >= 1; --q)
    if (std::abs(q * slope - std::round(q * slope)) * cells < 1.0)
      sigma_cells = std::max(sigma_cells, 1.0 / (q * std::sqrt(12.0)));
  const double inverse_cos2 = 1.0 + slope * slope;  // across the wall, not along the other axis
  const double sigma_m = plan.cell_m * std::min(sigma_cells, 1.0 / std::sqrt(12.0));
  return sigma_m * sigma_m / inverse_cos2;
}

/// Whether two walls meet at an angle. What ends near one of them is then nearer to it than to the other, a
/// little way from where they meet.
bool is_corner(const WallIndex::Wall& wall, const WallIndex::Wall& other) {
  const double sine = wall.along.x() * other.along.y() - wall.along.y() * other.along.x();
  if (std::abs(sine) < 0.7) return false;
  const auto meets = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return (p - q).squaredNorm() < 1e-12;
  };
  const Eigen::Vector2d end = wall.a + wall.length_m * wall.along;
  const Eigen::Vector2d other_end = other.a + other.length_m * other.along;
  return meets(wall.a, other.a) || meets(wall.a, other_end) || meets(end, other.a) || meets(end, other_end);
}

}  // namespace

WallIndex::WallIndex(const FloorPlan& plan, double reach_m, double cell_m)
    : reach_m_(reach_m), cell_m_(cell_m) {
  const std::vector<Segment2> segments = distinct(plan.segments());
  if (segments.empty()) return;
  bounds_ = plan.bounds();
  const Tiling tiling = tiling_of(bounds_, segments, reach_m_, kTile * cell_m_);
  low_ = tiling.low;
  cell_m_ = tiling.side_m / kTile;
  cells_per_m_ = 1.0 / cell_m_;
  columns_ = static_cast<int>(kTile) * tiling.columns;
  rows_ = static_cast<int>(kTile) * tiling.rows;
  tile_columns_ = static_cast<std::size_t>(tiling.columns);
  walls_.reserve(segments.size());
  for (const Segment2& segment : segments)
    walls_.push_back({segment.a, (segment.b - segment.a).normalized(), segment.length_m(),
                      variance_of_read(plan, segment)});

  // Of the walls within reach of any point of a tile, those that can be nearest somewhere in each cell.
  const WallsOfTiles within_reach(segments, reach_m_ + 0.5 * std::numbers::sqrt2 * tiling.side_m, tiling);
  WallTiles divided(walls_, reach_m_, cell_m_);
  tiles_.assign(tiling.count(), 0);
  for (int y = 0; y < tiling.rows; ++y)
    for (int x = 0; x < tiling.columns; ++x) {
      const std::size_t tile = tiling.tile(x, y);
      const std::span<const std::uint32_t> here = within_reach.of(tile);
      if (!here.empty()) tiles_[tile] = divided.add(tiling.center_of(x, y), here);
    }
  cells_ = std::move(divided.cells);
  lists_ = std::move(divided.lists);
  cells_.shrink_to_fit();
  lists_.shrink_to_fit();
  for (Wall& wall : walls_) find_clear_stretches(wall);
  stretches_.shrink_to_fit();
}

/// By steps of a quarter of a cell. What is not in the list of a cell is further away than asked for.
void WallIndex::find_clear_stretches(Wall& wall) {
  const double clear_m2 = 0.5 * cell_m_ * cell_m_;
  const double corner_m2 = 0.25 * clear_m2;
  const auto is_clear = [&](const Eigen::Vector2d& point) {
    const auto here = near(point);
    return std::all_of(here.begin(), here.end(), [&](std::uint32_t id) {
      const Wall& other = walls_[id];
      const double at_m = std::clamp(other.along.dot(point - other.a), 0.0, other.length_m);
      const double least_m2 = is_corner(wall, other) ? corner_m2 : clear_m2;
      return &other == &wall || (point - other.a - at_m * other.along).squaredNorm() > least_m2;
    });
  };
  const auto steps = static_cast<std::int64_t>(std::ceil(wall.length_m / (0.25 * cell_m_)));
  const double step_m = wall.length_m / static_cast<double>(steps);
  wall.first_clear = static_cast<std::uint32_t>(stretches_.size());
  Stretch stretch;
  bool was_clear = false;
  const auto end = [&] {
    if (was_clear && stretch.to_m > stretch.from_m) stretches_.push_back(stretch);
  };
  for (std::int64_t i = 0; i <= steps; ++i) {
    const double at_m = step_m * static_cast<double>(i);
    const bool is_clear_here = is_clear(wall.a + at_m * wall.along);
    if (is_clear_here && !was_clear) stretch.from_m = at_m;
    if (is_clear_here)
      stretch.to_m = at_m;
    else
      end();
    was_clear = is_clear_here;
  }
  end();
  wall.clear_count = static_cast<std::uint32_t>(stretches_.size()) - wall.first_clear;
}

std::size_t WallIndex::memory_bytes() const {
  return walls_.capacity() * sizeof(Wall) + stretches_.capacity() * sizeof(Stretch) +
         (tiles_.capacity() + cells_.capacity() + lists_.capacity()) * sizeof(std::uint32_t);
}

std::optional<SurfacePoint> WallIndex::nearest(const Eigen::Vector2d& point) const {
  double best = reach_m_ * reach_m_;
  const Wall* nearest_wall = nullptr;
  Eigen::Vector2d foot = Eigen::Vector2d::Zero();
  for (const std::uint32_t id : near(point)) {
    const Wall& wall = walls_[id];
    const double s = std::clamp(wall.along.dot(point - wall.a), 0.0, wall.length_m);
    const Eigen::Vector2d at = wall.a + s * wall.along;
    const double square = (point - at).squaredNorm();
    if (square > best) continue;
    best = square;
    nearest_wall = &wall;
    foot = at;
  }
  if (nearest_wall == nullptr) return std::nullopt;
  return SurfacePoint{foot, {-nearest_wall->along.y(), nearest_wall->along.x()}, std::sqrt(best)};
}

}  // namespace beaconless
