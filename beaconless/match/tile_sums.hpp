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
  using Words = std::uint16_t __attribute__((vector_size(NearnessPyramid::kTileColumns)));

  static constexpr std::size_t kMostCells = 257;  ///< sums of so many bytes fit into 16 bits

  std::array<Words, NearnessPyramid::kTileRows> even{};  ///< of the columns 0, 2, 4 …, a row each
  std::array<Words, NearnessPyramid::kTileRows> odd{};

  int at(int column, int row) const {
    const auto r = static_cast<std::size_t>(row);
    return (column % 2 == 0 ? even[r] : odd[r])[column / 2];
  }
};

/// Adds up the tiles that begin `x`, `y` cells from each of at most kMostCells cells. Cost: some thirty
/// instructions a cell, on any processor.
TileSums sum_tiles(const NearnessPyramid& map, int level, std::span<const Cell> cells, int x, int y);

}  // namespace beaconless
