// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/cell_index.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "beaconless/map/nearest_cells.hpp"

namespace beaconless {
namespace {

constexpr int kNeighbourhood_cells = 3;
constexpr double kThinWall =
    0.06;  // spread across / spread along, squared, below which surface cells make a line
constexpr double kThickWall = 0.25;  // the same for all occupied cells, where walls are several cells thick
constexpr int kFewestOfALine = 4;

bool is_surface(const OccupancyGrid& grid, Cell cell) {
  return grid.is_occupied(cell) &&
         (!grid.is_occupied({cell.x - 1, cell.y}) || !grid.is_occupied({cell.x + 1, cell.y}) ||
          !grid.is_occupied({cell.x, cell.y - 1}) || !grid.is_occupied({cell.x, cell.y + 1}));
}

struct LocalLine {
  Eigen::Vector2d middle;  // cells
  Eigen::Vector2d along;   // unit, or zero
};

/// The principal axis of the marked cells around `cell`; `along` is zero where they make no line.
LocalLine line_around(const std::vector<bool>& marked, int width, int height, Cell cell, double flatness) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  int count = 0;
  const int r = kNeighbourhood_cells;
  for (int dy = -r; dy <= r; ++dy) {
    for (int dx = -r; dx <= r; ++dx) {
      const int x = cell.x + dx;
      const int y = cell.y + dy;
      if (dx * dx + dy * dy > r * r + 1 || x < 0 || y < 0 || x >= width || y >= height) continue;
      if (!marked[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)])
        continue;
      const Eigen::Vector2d d(dx, dy);
      sum += d;
      square += d * d.transpose();
      ++count;
    }
  }
  const Eigen::Vector2d here(cell.x + 0.5, cell.y + 0.5);
  if (count < kFewestOfALine) return {here, Eigen::Vector2d::Zero()};
  const Eigen::Vector2d mean = sum / count;
  const Eigen::Matrix2d spread = square / count - mean * mean.transpose();
  const double half_difference = 0.5 * (spread(0, 0) - spread(1, 1));
  const double root = std::hypot(half_difference, spread(0, 1));
  const double middle = 0.5 * spread.trace();
  if (middle - root > flatness * (middle + root)) return {here, Eigen::Vector2d::Zero()};
  const double angle = 0.5 * std::atan2(spread(0, 1), half_difference);
  return {here + mean, {std::cos(angle), std::sin(angle)}};
}

}  // namespace

CellIndex::CellIndex(const OccupancyGrid& grid, double reach_m)
    : reach_m_(reach_m),
      resolution_m_(grid.resolution_m),
      margin_(static_cast<int>(std::ceil(reach_m / grid.resolution_m))),
      width_(grid.width_cells + 2 * margin_),
      height_(grid.height_cells + 2 * margin_),
      map_from_grid_(grid.map_from_grid),
      grid_rotation_(grid.map_from_grid.rotation()) {
  std::vector<bool> surface(grid.occupancy_percent.size(), false);
  std::vector<bool> occupied(grid.occupancy_percent.size(), false);
  std::vector<Cell> cells;
  std::vector<std::int32_t> seeds;
  for (int y = 0; y < grid.height_cells; ++y) {
    for (int x = 0; x < grid.width_cells; ++x) {
      occupied[grid.index({x, y})] = grid.is_occupied({x, y});
      if (!is_surface(grid, {x, y})) continue;
      surface[grid.index({x, y})] = true;
      cells.push_back({x, y});
      seeds.push_back((y + margin_) * width_ + x + margin_);
    }
  }
  surfaces_.reserve(cells.size());
  for (const Cell& cell : cells) {
    LocalLine line = line_around(surface, grid.width_cells, grid.height_cells, cell, kThinWall);
    if (line.along.isZero())
      line = line_around(occupied, grid.width_cells, grid.height_cells, cell, kThickWall);
    surfaces_.push_back({(resolution_m_ * line.middle).cast<float>(), line.along.cast<float>()});
  }
  nearest_ = nearest_seeds(width_, height_, seeds, reach_m_ / resolution_m_);
}

FloorPlan::Bounds CellIndex::bounds() const {
  if (surfaces_.empty()) return {};
  const double half = 0.5 * std::sqrt(2.0) * resolution_m_;
  Eigen::AlignedBox2d box;
  for (const Surface& surface : surfaces_) box.extend(map_from_grid_ * surface.point.cast<double>().eval());
  return {box.min().array() - half, box.max().array() + half};
}

std::optional<SurfacePoint> CellIndex::nearest(const Eigen::Vector2d& point_map) const {
  const Eigen::Vector2d point = grid_rotation_.transpose() * (point_map - map_from_grid_.translation());
  const double x = point.x() / resolution_m_ + margin_;
  const double y = point.y() / resolution_m_ + margin_;
  if (!(x >= 0.0 && y >= 0.0 && x < width_ && y < height_)) return std::nullopt;
  const std::int32_t found =
      nearest_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  if (found < 0) return std::nullopt;

  const Surface& surface = surfaces_[static_cast<std::size_t>(found)];
  const Eigen::Vector2d along = surface.along.cast<double>();
  const double length = kNeighbourhood_cells * resolution_m_;
  Eigen::Vector2d foot = surface.point.cast<double>();
  foot += std::clamp(along.dot(point - foot), -length, length) * along;
  const Eigen::Vector2d off = point - foot;
  const double distance = off.norm();
  Eigen::Vector2d normal(-along.y(), along.x());
  if (along.isZero()) normal = distance > 0.0 ? Eigen::Vector2d(off / distance) : Eigen::Vector2d::UnitX();
  return SurfacePoint{map_from_grid_.translation() + grid_rotation_ * foot, grid_rotation_ * normal,
                      distance};
}

}  // namespace beaconless
