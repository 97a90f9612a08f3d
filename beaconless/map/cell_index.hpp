// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/map/surface_point.hpp"

namespace beaconless {

/// Finds the surface of a grid map nearest to a point.
///
/// A surface cell is an occupied cell with a neighbour that is not. Where the surface cells around it lie on
/// a line, that line stands for the surface (so that a wall does not look like a row of steps); elsewhere its
/// middle does. Cost: one look-up a query; built in time linear in the cells. Source: exact nearest cells by
/// Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", 2012, with the winner's index
/// kept; the lines are principal axes of the neighbouring cells. Differs: the dissertation matches occupied
/// cells; their middles alone cost up to half a cell of accuracy.
class CellIndex {
 public:
  /// Surfaces further than about `reach_m` from a query are not found.
  explicit CellIndex(const OccupancyGrid& grid, double reach_m = 1.0);

  std::optional<SurfacePoint> nearest(const Eigen::Vector2d& point_map) const;

  double reach_m() const { return reach_m_; }
  FloorPlan::Bounds bounds() const;  ///< of the surface cells; both zero where there are none
  std::size_t surface_count() const { return surfaces_.size(); }

 private:
  struct Surface {
    Eigen::Vector2f point;  // grid frame, metres
    Eigen::Vector2f along;  // unit; zero where the cells make no line
  };

  double reach_m_ = 0.0;
  double resolution_m_ = 0.0;
  int margin_ = 0;  // cells around the grid's own, so that surfaces at its edge are found from outside too
  int width_ = 0;   // with the margin
  int height_ = 0;
  Pose2 map_from_grid_;
  Eigen::Matrix2d grid_rotation_ = Eigen::Matrix2d::Identity();
  std::vector<Surface> surfaces_;
  std::vector<std::int32_t> nearest_;  // per cell: index into surfaces_, or -1 where none is within reach
};

static_assert(SurfaceIndex<CellIndex>);

}  // namespace beaconless
