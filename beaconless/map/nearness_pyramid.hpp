// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// How near the map's surfaces are to every place, a byte a cell, and the greatest of that in ever larger
/// blocks of cells.
///
/// A cell holds kOnSurface where its middle is on a surface, 0 where every surface is `truncate_m` away or
/// further, and falls with the square of the distance between. There is a block at every cell, not only at
/// multiples of its size; blocks a block's width apart lie side by side, so that a tile of them is read at
/// once. Frame: map, cells along its axes. Cost: built in a look-up and four bytes or so a cell; cells are
/// made larger where the surfaces would need more than kMaxCells, and `truncate_m` is no less than two.
/// Source: Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM", ICRA 2016, V-B (a pre-computed grid a
/// level). Differs: levels are four times as coarse as the one before, and sorted by phase.
class NearnessPyramid {
 public:
  static constexpr int kOnSurface = 255;
  static constexpr int kLevels = 3;  ///< blocks of 1, 4 and 16 cells a side
  static constexpr int kTileColumns = 16;
  static constexpr int kTileRows = 4;
  static constexpr double kMaxCells = 4e6;

  explicit NearnessPyramid(const SurfaceMap& map, double cell_m = 0.05, double truncate_m = 0.2);

  double cell_m() const { return cell_m_; }
  const Eigen::Vector2d& low() const { return low_; }  ///< the corner of cell (0, 0)
  int width_cells() const { return width_; }
  int height_cells() const { return height_; }
  std::size_t bytes() const;  ///< that it takes

  /// How many cells wide a block is.
  static constexpr int block_cells(int level) { return 1 << (2 * level); }

  /// The tile of blocks whose first is at `cell`: kTileColumns bytes, the same again pitch() further, and so
  /// on, kTileRows times. Null where all of them are 0.
  const std::uint8_t* tile(int level, Cell cell) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    const int shift = 2 * level;
    const int last = (1 << shift) - 1;
    const auto column = static_cast<unsigned>((cell.x >> shift) + kLeft);
    const auto row = static_cast<unsigned>((cell.y >> shift) + kBelow);
    if (column >= of.pitch || row >= of.filled_rows) return nullptr;
    const auto phase = static_cast<unsigned>(((cell.y & last) << shift) | (cell.x & last));
    return of.bytes.data() + (std::size_t{phase} * of.rows + row) * of.pitch + column;
  }
  std::size_t pitch(int level) const { return levels_[static_cast<std::size_t>(level)].pitch; }

 private:
  // Zeros around every image, so that tiles that are partly outside need no care: a row's are also those on
  // the right of the row before it. The block at -1 still touches cell 0.
  static constexpr int kLeft = kTileColumns;
  static constexpr int kBelow = kTileRows;

  /// An image for every phase, that is for every place of a block within a block's width.
  struct Level {
    unsigned pitch = 0;
    unsigned filled_rows = 0;  ///< zeros below, and rows that hold something
    unsigned rows = 0;         ///< the same with zeros above
    std::vector<std::uint8_t> bytes;
  };

  Level make_level(int level, const std::vector<std::uint8_t>& finest) const;

  double cell_m_ = 0.0;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::array<Level, kLevels> levels_;
};

}  // namespace beaconless
