// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

  std::optional<SurfacePoint> nearest(const Eigen::Vector2d& point_map) const;

  double reach_m() const { return reach_m_; }
  std::size_t wall_count() const { return walls_.size(); }

 private:
  struct Wall {
    Eigen::Vector2d a;
    Eigen::Vector2d along;  // unit
    double length_m;
  };

  std::vector<Wall> walls_;
  double reach_m_ = 0.0;
  double cell_m_ = 0.0;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  // candidates_[first_[c] … first_[c + 1]) belong to cell c
  std::vector<std::uint32_t> candidates_;
};

static_assert(SurfaceIndex<WallIndex>);

}  // namespace beaconless
