// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/nearness_pyramid.hpp"
#include "beaconless/match/lattice_search.hpp"
#include "beaconless/match/tile_sums.hpp"

namespace beaconless {

/// What the poses of a lattice cost, one by one or at least in blocks: 0 where all points are on surfaces,
/// worst() where none is near any, and what being far adds; whole numbers.
class LatticeBounds {
 public:
  using Block = LatticeScratch::Block;

  /// In: points in the laser frame; all that is referred to must outlive this. Fills `cells` with theirs at
  /// every heading.
  LatticeBounds(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                const PoseLattice& lattice, std::vector<Cell>& cells);

  int worst() const { return worst_; }
  int headings() const { return 2 * lattice_.turns + 1; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  /// The first pose of a block.
  Pose2 pose_of(const Block& block) const {
    return {lattice_.middle.x_m + (block.x - lattice_.moves_x) * map_.cell_m(),
            lattice_.middle.y_m + (block.y - lattice_.moves_y) * map_.cell_m(), theta_of(block.heading)};
  }

  /// Calls visit(block) for every block of a tile that begins in the lattice and has a bound within `limit`.
  ///
  /// In: level and heading of its blocks, the first pose of the tile's first one, how many there are.
  template <class Visit>
  void for_tile(int level, int heading, int x, int y, int columns, int rows, int limit,
                const Visit& visit) const {
    const int step = NearnessPyramid::block_cells(level);
    const int turned = turn_penalty(heading);
    const TileSums sums = sum_tiles(map_, level, cells_at(heading), x, y, worst_ + turned - limit);
    for (int row = 0; row < rows && y + row * step < rows_; ++row)
      for (int column = 0; column < columns && x + column * step < columns_; ++column) {
        const int bx = x + column * step;
        const int by = y + row * step;
        const int misfit = worst_ - sums.at(column, row);
        if (misfit + turned > limit) continue;
        const int cost = misfit + std::max(turned, move_penalty(level, bx, by));
        if (cost <= limit) visit(Block{cost, level, heading, bx, by});
      }
  }

 private:
  void turn(std::span<const Eigen::Vector2d> points, std::vector<Cell>& cells) const;
  float penalty_per_step2(int steps) const;
  double theta_of(int heading) const {
    return wrap_angle(lattice_.middle.theta_rad + (heading - lattice_.turns) * lattice_.step_rad);
  }
  int turn_penalty(int heading) const {
    const int turned = heading - lattice_.turns;
    return static_cast<int>(per_turn2_ * static_cast<float>(turned * turned));
  }
  /// The least of any of its poses.
  int move_penalty(int level, int x, int y) const {
    const int last = NearnessPyramid::block_cells(level) - 1;
    const int dx = std::max({0, x - lattice_.moves_x, lattice_.moves_x - x - last});
    const int dy = std::max({0, y - lattice_.moves_y, lattice_.moves_y - y - last});
    return static_cast<int>(per_move2_ * static_cast<float>(dx * dx + dy * dy));
  }
  std::span<const Cell> cells_at(int heading) const {
    return cells_.subspan(static_cast<std::size_t>(heading) * points_, points_);
  }

  std::size_t points_;
  const NearnessPyramid& map_;
  const PoseLattice& lattice_;
  std::span<const Cell> cells_;
  int columns_;
  int rows_;
  int worst_;
  float per_move2_;
  float per_turn2_;
};

}  // namespace beaconless
