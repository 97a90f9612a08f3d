// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/surface_point.hpp"

namespace beaconless {

/// Finds the wall nearest to a point: a grid of cells, each with the few walls that can be nearest anywhere
/// in it.
///
/// Exact: the answer is that of comparing with every wall. Cost: one cell and usually one to three walls a
/// query; built in time and memory linear in the walls' area of reach. Source: uniform bucketing; the
/// candidate rule d(center) <= d_min(center) + diagonal follows from the triangle inequality.
class WallIndex {
 public:
  /// Walls further than `reach_m` from a query are not found. `cell_m` trades memory for candidates per cell;
  /// it is made larger where the plan would need more than kMaxCells.
  explicit WallIndex(const FloorPlan& plan, double reach_m = 1.0, double cell_m = 0.10);

  static constexpr double kMaxCells = 16e6;

  struct Wall {
    Eigen::Vector2d a;
    Eigen::Vector2d along;  ///< unit
    double length_m;
  };

  std::optional<SurfacePoint> nearest(const Eigen::Vector2d& point_map) const;
  /// Every wall that is nearest to some point of the cell in which this one lies, and a few more.
  std::span<const std::uint32_t> near(const Eigen::Vector2d& point_map) const {
    const double x = (point_map.x() - low_.x()) * cells_per_m_;
    const double y = (point_map.y() - low_.y()) * cells_per_m_;
    if (!(x >= 0.0 && y >= 0.0 && x < columns_ && y < rows_)) return {};  // NaN too
    const std::uint32_t* const first =
        first_.data() + static_cast<std::ptrdiff_t>(y) * columns_ + static_cast<std::ptrdiff_t>(x);
    return {candidates_.data() + first[0], candidates_.data() + first[1]};
  }
  const Wall& wall(std::uint32_t id) const { return walls_[id]; }

  double reach_m() const { return reach_m_; }
  const FloorPlan::Bounds& bounds() const { return bounds_; }  ///< of the walls
  std::size_t wall_count() const { return walls_.size(); }

 private:
  std::vector<Wall> walls_;
  double reach_m_ = 0.0;
  double cell_m_ = 0.0;
  double cells_per_m_ = 0.0;
  FloorPlan::Bounds bounds_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  // candidates_[first_[c] … first_[c + 1]) belong to cell c
  std::vector<std::uint32_t> candidates_;
};

static_assert(SurfaceIndex<WallIndex>);

}  // namespace beaconless
