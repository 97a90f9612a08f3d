// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless {

/// A grid that is looked up between its cells: M in [0, 1], bilinear between the middles of the cells; 1
/// where an obstacle is, 0 where none is known.
///
/// Unknown cells count as 0, like free ones, and is_known() tells them apart: the border of what was seen has
/// no slope and pulls no beam. Values are kept in steps of 1/254 (at 5 cm: 0.2 mm along a slope of one cell).
/// Layout: a word for every cell, with the values of the cell itself, its right, upper and upper right
/// neighbour, so that one load gives all that an interpolation needs.
/// Source: Kohlbrecher et al., "A flexible and scalable SLAM system with full 3D motion estimation", SSRR
/// 2011. Differs: there unknown cells hold 0.5, next to walls of 0.9 and free cells of 0.1, so that a wall
/// has a steep and a flat side and beams are pulled through it, into the unknown.
class OccupancyLevel {
 public:
  /// No cells yet: cover() some. `map_from_grid` is the outer corner of cell (0, 0), heading included.
  OccupancyLevel(double resolution_m, const Pose2& map_from_grid);

  /// M for a probability that a cell is occupied: 2 p - 1, and 0 below an even chance, so that the unknown
  /// (0.5) and all that is rather free are one even ground, and a certain wall is worth 1: what is left at
  /// the top of a ridge, 1 - M, makes Gauss-Newton step too far by as much of a cell.
  static double value_of(double probability) { return probability > 0.5 ? 2.0 * probability - 1.0 : 0.0; }

  /// Makes room for the cells from `low` to `high`, both included, and keeps what is known. New cells are
  /// unknown. Cells may be negative; map_from_grid() never changes.
  ///
  /// Errors, and then nothing is changed: more than kMaxCells. Cost: nothing where there is room, else a
  /// copy, with room to spare so that a long drive copies seldom.
  Result<Done> cover(Cell low, Cell high);

  /// Sets a cell; one without room is left out. In: a value, cut to [0, 1]. Cost: four bytes.
  void set(Cell cell, double value) { put(cell, steps_of(value)); }
  void forget(Cell cell) { put(cell, kUnknown); }

  bool is_known(Cell cell) const { return byte(cell) != kUnknown; }
  double value(Cell cell) const { return is_known(cell) ? byte(cell) / kSteps : 0.0; }

  /// M and its slope at a point of the map; 0 outside. The plain form of what a matcher does with stencils().
  struct Sample {
    double value = 0.0;
    Eigen::Vector2d slope_per_m = Eigen::Vector2d::Zero();  ///< along the map's axes
  };
  Sample sample(const Eigen::Vector2d& point_map) const;

  double resolution_m() const { return resolution_m_; }
  const Pose2& map_from_grid() const { return map_from_grid_; }
  Cell low() const { return low_; }    ///< the first cell that has room
  Cell high() const { return high_; }  ///< the last one

  /// Whether M is above 0 somewhere between the middles of this cell and the next to the right and above.
  bool is_near_obstacle(Cell cell) const;

  /// Row by row, from cell low() - (2, 2) to high() + (1, 1): the values of the cell (lowest byte), its
  /// right, upper and upper right neighbour, in steps; kUnknown where unknown. The first and last rows and
  /// columns are unknown throughout, so that a point outside may be moved there.
  const std::vector<std::uint32_t>& stencils() const { return stencils_; }
  int stride() const { return high_.x - low_.x + 4; }
  int rows() const { return high_.y - low_.y + 4; }

  static constexpr double kSteps = 254.0;
  static constexpr std::uint8_t kUnknown = 255;
  static constexpr std::int64_t kMaxCells = 100'000'000;

 private:
  bool has_room(Cell cell) const {
    return cell.x >= low_.x && cell.y >= low_.y && cell.x <= high_.x && cell.y <= high_.y;
  }
  static std::uint8_t steps_of(double value) {
    constexpr double kHalfStep = 0.5;
    return static_cast<std::uint8_t>(kSteps * (value > 0.0 ? std::min(value, 1.0) : 0.0) + kHalfStep);
  }
  std::size_t place(Cell cell) const;
  std::uint8_t byte(Cell cell) const;
  void put(Cell cell, std::uint8_t value);

  double resolution_m_;
  Pose2 map_from_grid_;
  Cell low_{0, 0};
  Cell high_{-1, -1};
  std::vector<std::uint32_t> stencils_;
};

}  // namespace beaconless
