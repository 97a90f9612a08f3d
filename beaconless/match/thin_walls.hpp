// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/match/drawn_lines.hpp"

namespace beaconless {

/// A straight wall of a few cells across, in cells of its grid.
struct ThinWall {
  CellsLine line;
  double from = 0.0;        ///< along, the middle of the first column that tells it
  double to = 0.0;          ///< … of the last
  int cells = 1;            ///< across, as usual
  std::size_t columns = 0;  ///< that tell it
  bool is_along_x = true;

  /// The point on its line, so far along.
  Eigen::Vector2d at(double along) const {
    const double across = line.across_at(along);
    return is_along_x ? Eigen::Vector2d(along, across) : Eigen::Vector2d(across, along);
  }
};

/// Looks at walls across them, for the middle of walls a few cells thick.
class ThinWalls {
 public:
  ThinWalls(const OccupancyGrid& grid, int most_cells) : grid_(grid), most_cells_(most_cells) {}

  const OccupancyGrid& grid() const { return grid_; }
  bool are_looked_at() const { return most_cells_ >= 2; }

  /// The occupied cells next to each other, across, from the one in which a point lies: their number and
  /// their middle by occupancy. Nothing where there are none or more than a thin wall has.
  std::optional<WallColumn> column_at(const Eigen::Vector2d& point, bool is_along_x) const;

  /// The wall that columns tell; `near` receives those of them that are its.
  std::optional<ThinWall> wall_of(const std::vector<WallColumn>& columns, bool is_along_x,
                                  std::vector<WallColumn>& near) const;

  /// The whole of a wall of which a part is known: goes on at both ends as long as there are cells where its
  /// line leads, past what stands against it. Cost: the wall's length, a few times.
  ThinWall whole(ThinWall wall) const;

 private:
  void collect(const ThinWall& wall, std::vector<WallColumn>& columns) const;
  bool is_occupied(int along, int across, bool is_along_x) const {
    return grid_.is_occupied(is_along_x ? Cell{along, across} : Cell{across, along});
  }

  const OccupancyGrid& grid_;
  int most_cells_;
};

}  // namespace beaconless
