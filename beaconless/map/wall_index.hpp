// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/surface_point.hpp"

namespace beaconless {

/// Finds the wall nearest to a point: tiles of 8 x 8 cells, each cell with the few walls that can be nearest
/// anywhere in it. A tile with one list for all its cells holds it once; one without walls holds nothing.
///
/// Exact: the answer is that of comparing with every wall. Cost: one tile, one cell and usually one to three
/// walls a query; built in time and memory linear in the walls' area of reach, and four bytes a tile of the
/// plan's area. Source: uniform bucketing; the candidate rule d(center) <= d_min(center) + diagonal follows
/// from the triangle inequality.
class WallIndex {
 public:
  /// Walls further than `reach_m` from a query are not found. `cell_m` trades memory for candidates per cell;
  /// it is made larger where the plan would need more than kMaxTiles.
  explicit WallIndex(const FloorPlan& plan, double reach_m = 1.0, double cell_m = 0.10);

  static constexpr double kMaxTiles = 16e6;

  struct Wall {
    Eigen::Vector2d a;
    Eigen::Vector2d along;  ///< unit
    double length_m;
    double variance_m2 = 0.0;  ///< of where it lies across, as a plan that was read from a grid leaves it
    std::uint32_t first_clear = 0;  ///< of its stretches, see clear_around()
    std::uint32_t clear_count = 0;
  };

  /// A part of a wall along which every other is at least half a diagonal of a cell away, or half of that
  /// from one that it meets at an angle.
  struct Stretch {
    double from_m = 0.0;
    double to_m = 0.0;
  };

  /// The stretch of a wall in which a place along it lies; one of no length where there is none.
  Stretch clear_around(const Wall& wall, double along_m) const {
    for (std::uint32_t i = wall.first_clear; i < wall.first_clear + wall.clear_count; ++i)
      if (along_m >= stretches_[i].from_m && along_m <= stretches_[i].to_m) return stretches_[i];
    return {};
  }

  std::optional<SurfacePoint> nearest(const Eigen::Vector2d& point_map) const;
  /// Every wall that is nearest to some point of the cell in which this one lies, and a few more.
  std::span<const std::uint32_t> near(const Eigen::Vector2d& point_map) const {
    const double x = (point_map.x() - low_.x()) * cells_per_m_;
    const double y = (point_map.y() - low_.y()) * cells_per_m_;
    if (!(x >= 0.0 && y >= 0.0 && x < columns_ && y < rows_)) return {};  // NaN too
    const auto column = static_cast<std::uint32_t>(x);
    const auto row = static_cast<std::uint32_t>(y);
    const std::uint32_t tile = tiles_[static_cast<std::size_t>(row / kTile) * tile_columns_ + column / kTile];
    const std::uint32_t cell = (row % kTile) * kTile + column % kTile;
    // Of a tile that is not divided all cells are its first.
    const std::uint32_t* const list = lists_.data() + cells_[tile / 2 + (cell & (0 - tile % 2))];
    return {list + 1, list[0]};
  }
  const Wall& wall(std::uint32_t id) const { return walls_[id]; }

  double reach_m() const { return reach_m_; }
  const FloorPlan::Bounds& bounds() const { return bounds_; }  ///< of the walls
  std::size_t wall_count() const { return walls_.size(); }
  /// What it holds on the heap.
  std::size_t memory_bytes() const;

 private:
  static constexpr std::uint32_t kTile = 8;  // cells along each side of a tile

  void find_clear_stretches(Wall& wall);

  std::vector<Wall> walls_;
  double reach_m_ = 0.0;
  double cell_m_ = 0.0;
  double cells_per_m_ = 0.0;
  FloorPlan::Bounds bounds_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int columns_ = 0;  // of cells
  int rows_ = 0;
  std::size_t tile_columns_ = 0;
  std::vector<std::uint32_t> tiles_;  // twice the number of a tile's first cell, and 1 if it is divided
  std::vector<std::uint32_t> cells_;  // where in lists_ the list of each begins
  std::vector<Stretch> stretches_;    // of all walls
  std::vector<std::uint32_t> lists_;  // how many walls, then which; cells of a tile share what is the same
};

static_assert(SurfaceIndex<WallIndex>);

}  // namespace beaconless
