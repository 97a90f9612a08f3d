// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "beaconless/map/wall_tiles.hpp"

namespace beaconless {
namespace {

/// Calls visit(column, row) for every cell whose center is within `reach_m` of a wall.
template <class Visit>
void for_cells_near(const Segment2& wall, double reach_m, const Eigen::Vector2d& low, double cell_m,
                    int columns, int rows, Visit visit) {
  const auto column_of = [&](double x) { return static_cast<int>(std::floor((x - low.x()) / cell_m)); };
  const auto row_of = [&](double y) { return static_cast<int>(std::floor((y - low.y()) / cell_m)); };
  const int y0 = std::max(0, row_of(std::min(wall.a.y(), wall.b.y()) - reach_m));
  const int y1 = std::min(rows - 1, row_of(std::max(wall.a.y(), wall.b.y()) + reach_m));
  const Eigen::Vector2d along = wall.b - wall.a;
  for (int y = y0; y <= y1; ++y) {
    // The part of the wall whose y lies within reach of this row bounds the columns worth looking at.
    double s0 = 0.0;
    double s1 = 1.0;
    if (std::abs(along.y()) > 1e-12) {
      const double middle = low.y() + (y + 0.5) * cell_m - wall.a.y();
      const double p = (middle - reach_m) / along.y();
      const double q = (middle + reach_m) / along.y();
      s0 = std::clamp(std::min(p, q), 0.0, 1.0);
      s1 = std::clamp(std::max(p, q), 0.0, 1.0);
    }
    const double xa = wall.a.x() + s0 * along.x();
    const double xb = wall.a.x() + s1 * along.x();
    const int x0 = std::max(0, column_of(std::min(xa, xb) - reach_m));
    const int x1 = std::min(columns - 1, column_of(std::max(xa, xb) + reach_m));
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2d center = low + cell_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      if (wall.distance_m(center) <= reach_m) visit(x, y);
    }
  }
}

constexpr double kMaxVisits = 4e7;  // of tiles by walls, so that no plan takes for ever

double area_of_reach(const std::vector<Segment2>& walls, double reach_m) {
  double area_m2 = 0.0;
  for (const Segment2& wall : walls) area_m2 += (wall.length_m() + 2.0 * reach_m) * 2.0 * reach_m;
  return area_m2;
}

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

}  // namespace

WallIndex::WallIndex(const FloorPlan& plan, double reach_m, double cell_m)
    : reach_m_(reach_m), cell_m_(cell_m) {
  const std::vector<Segment2> segments = distinct(plan.segments());
  walls_.reserve(segments.size());
  for (const Segment2& segment : segments)
    walls_.push_back({segment.a, (segment.b - segment.a).normalized(), segment.length_m()});
  if (walls_.empty()) return;

  const FloorPlan::Bounds bounds = plan.bounds();
  low_ = bounds.low.array() - reach_m_;
  const Eigen::Vector2d extent = bounds.high.array() + reach_m_ - low_.array();
  const double tile_m = std::max({kTile * cell_m_, std::sqrt(extent.x() * extent.y() / kMaxTiles),
                                  std::sqrt(area_of_reach(segments, reach_m_) / kMaxVisits)});
  cell_m_ = tile_m / kTile;
  cells_per_m_ = 1.0 / cell_m_;
  const auto tile_columns = static_cast<int>(std::ceil(extent.x() / tile_m));
  const auto tile_rows = static_cast<int>(std::ceil(extent.y() / tile_m));
  tile_columns_ = static_cast<std::size_t>(tile_columns);
  columns_ = static_cast<int>(kTile) * tile_columns;
  rows_ = static_cast<int>(kTile) * tile_rows;

  // 1. The walls within reach of each tile, one tile after the other.
  const std::size_t tile_count = tile_columns_ * static_cast<std::size_t>(tile_rows);
  const double reach = reach_m_ + 0.5 * std::numbers::sqrt2 * tile_m;
  const auto visit_all = [&](auto visit) {
    for (std::uint32_t i = 0; i < segments.size(); ++i)
      for_cells_near(segments[i], reach, low_, tile_m, tile_columns, tile_rows, [&](int x, int y) {
        visit(static_cast<std::size_t>(y) * tile_columns_ + static_cast<std::size_t>(x), i);
      });
  };
  std::vector<std::uint32_t> ends(tile_count + 1, 0);
  visit_all([&](std::size_t tile, std::uint32_t /*wall*/) { ++ends[tile + 1]; });
  for (std::size_t tile = 0; tile < tile_count; ++tile) ends[tile + 1] += ends[tile];
  std::vector<std::uint32_t> within_reach(ends.back());
  // While a tile is filled, its entry is where the next wall goes: in the end where the next tile begins.
  visit_all([&](std::size_t tile, std::uint32_t wall) { within_reach[ends[tile]++] = wall; });

  // 2. Of those, the ones that can be nearest somewhere in each cell.
  WallTiles divided(walls_, reach_m_, cell_m_);
  tiles_.assign(tile_count, 0);
  std::uint32_t begin = 0;
  for (std::size_t tile = 0; tile < tile_count; ++tile) {
    const std::span<const std::uint32_t> here(within_reach.data() + begin, within_reach.data() + ends[tile]);
    begin = ends[tile];
    if (here.empty()) continue;
    const Eigen::Vector2d place(static_cast<double>(tile % tile_columns_) + 0.5,
                                static_cast<double>(tile / tile_columns_) + 0.5);
    tiles_[tile] = divided.add(low_ + tile_m * place, here);
  }
  cells_ = std::move(divided.cells);
  lists_ = std::move(divided.lists);
  cells_.shrink_to_fit();
  lists_.shrink_to_fit();
}

std::size_t WallIndex::memory_bytes() const {
  return walls_.capacity() * sizeof(Wall) +
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
