// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "beaconless/map/nearness_pyramid.hpp"

namespace beaconless {

/// For every block of a tile the sum of its nearness at several cells.
struct TileSums {
  static constexpr std::size_t kMostCells = 257;  ///< sums of so many bytes fit into 16 bits

  using HalfRow = std::array<std::uint16_t, NearnessPyramid::kTileColumns / 2>;
  std::array<HalfRow, NearnessPyramid::kTileRows> even{};  ///< of the columns 0, 2, 4 …
  std::array<HalfRow, NearnessPyramid::kTileRows> odd{};

  int at(int column, int row) const {
    const auto& half = column % 2 == 0 ? even : odd;
    return half[static_cast<std::size_t>(row)][static_cast<std::size_t>(column) / 2];
  }
};

/// Adds up the tiles that begin `x`, `y` cells from each of at most kMostCells cells. Nothing is wanted below
/// `least`: all sums are 0 where it is clear from some of the cells that none reaches that. Cost: some thirty
/// instructions a cell, on any processor.
TileSums sum_tiles(const NearnessPyramid& map, int level, std::span<const Cell> cells, int x, int y,
                   int least = 0);

}  // namespace beaconless
