// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// The position of a cell: x to the right, y up, (0, 0) at the grid's origin.
struct Cell {
  int x = 0;
  int y = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// A map of square cells, each occupied, free, in between, or unknown, as in nav_msgs/OccupancyGrid.
///
/// Row-major from the lower left cell. `map_from_grid` is the pose of that cell's outer corner, heading
/// included.
struct OccupancyGrid {
  static constexpr std::int8_t kUnknown = -1;
  static constexpr std::int8_t kFree = 0;
  static constexpr std::int8_t kOccupied = 100;

  double resolution_m = 0.05;
  Pose2 map_from_grid;
  int width_cells = 0;
  int height_cells = 0;
  std::vector<std::int8_t> occupancy_percent;  ///< width x height; -1 unknown, 0 free … 100 occupied
  std::int8_t occupied_from_percent = 65;      ///< a cell at or above this is an obstacle
  std::int8_t free_to_percent = 20;            ///< a known cell at or below this is free

  bool contains(Cell cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < width_cells && cell.y < height_cells;
  }
  std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_cells) +
           static_cast<std::size_t>(cell.x);
  }
  std::int8_t at(Cell cell) const { return contains(cell) ? occupancy_percent[index(cell)] : kUnknown; }
  bool is_occupied(Cell cell) const { return at(cell) >= occupied_from_percent; }
  bool is_free(Cell cell) const { return at(cell) >= 0 && at(cell) <= free_to_percent; }

  /// The cell that holds a point of the map frame; may lie outside.
  Cell cell_at(const Eigen::Vector2d& point_map) const;

  /// The middle of a cell, in the map frame.
  Eigen::Vector2d center(Cell cell) const;

  friend bool operator==(const OccupancyGrid&, const OccupancyGrid&) = default;
};

}  // namespace beaconless
