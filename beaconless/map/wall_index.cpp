// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace beaconless {
namespace {

/// Calls visit(column, row, distance from the cell's center to the wall) for every cell within `reach_m` of
/// it.
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
      const double distance = wall.distance_m(center);
      if (distance <= reach_m) visit(x, y, distance);
    }
  }
}

constexpr double kMaxVisits = 5e7;  // of cells by walls, so that no plan takes for ever

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
  for (const Segment2& segment : segments)
    walls_.push_back({segment.a, (segment.b - segment.a).normalized(), segment.length_m()});
  if (walls_.empty()) return;

  bounds_ = plan.bounds();
  low_ = bounds_.low.array() - reach_m_;
  const Eigen::Vector2d extent = bounds_.high.array() + reach_m_ - low_.array();
  cell_m_ = std::max({cell_m_, std::sqrt(extent.x() * extent.y() / kMaxCells),
                      std::sqrt(area_of_reach(segments, reach_m_) / kMaxVisits)});
  cells_per_m_ = 1.0 / cell_m_;
  columns_ = static_cast<int>(std::ceil(extent.x() / cell_m_));
  rows_ = static_cast<int>(std::ceil(extent.y() / cell_m_));
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const auto cell_of = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  };

  // Any point of a cell is within half a diagonal of its center, so a wall can be nearest to it only when it
  // is within a whole diagonal of being nearest to the center.
  const double diagonal = cell_m_ * std::sqrt(2.0);
  const double reach = reach_m_ + 0.5 * diagonal;
  std::vector<float> nearest(cells, std::numeric_limits<float>::infinity());
  for (const Segment2& segment : segments)
    for_cells_near(segment, reach, low_, cell_m_, columns_, rows_, [&](int x, int y, double distance) {
      nearest[cell_of(x, y)] = std::min(nearest[cell_of(x, y)], static_cast<float>(distance));
    });
  const auto is_candidate = [&](std::size_t cell, double distance) {
    return distance <= static_cast<double>(nearest[cell]) + diagonal + 1e-5;
  };
  first_.assign(cells + 1, 0);
  for (const Segment2& segment : segments)
    for_cells_near(segment, reach, low_, cell_m_, columns_, rows_, [&](int x, int y, double distance) {
      if (is_candidate(cell_of(x, y), distance)) ++first_[cell_of(x, y) + 1];
    });
  for (std::size_t cell = 0; cell < cells; ++cell) first_[cell + 1] += first_[cell];
  candidates_.resize(first_[cells]);
  std::vector<std::uint32_t> filled(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < segments.size(); ++i)
    for_cells_near(segments[i], reach, low_, cell_m_, columns_, rows_, [&](int x, int y, double distance) {
      if (is_candidate(cell_of(x, y), distance)) candidates_[filled[cell_of(x, y)]++] = i;
    });
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
