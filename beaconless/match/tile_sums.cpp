// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/tile_sums.hpp"

#include <bit>
#include <cstring>
#include <utility>

namespace beaconless {

TileSums sum_tiles(const NearnessPyramid& map, int level, std::span<const Cell> cells, int x, int y) {
  // Two bytes at a time in 16 bits, so that sums have room without any of the bytes being moved.
  constexpr int kByte = 8;
  constexpr std::uint16_t kLow = 0xff;
  const std::size_t pitch = map.pitch(level);
  TileSums sums;
  for (const Cell& cell : cells) {
    const std::uint8_t* from = map.tile(level, {cell.x + x, cell.y + y});
    if (from == nullptr) continue;
    for (std::size_t row = 0; row < NearnessPyramid::kTileRows; ++row, from += pitch) {
      TileSums::Words bytes;
      std::memcpy(&bytes, from, sizeof(bytes));
      sums.even[row] += bytes & kLow;
      sums.odd[row] += bytes >> kByte;
    }
  }
  if constexpr (std::endian::native == std::endian::big) std::swap(sums.even, sums.odd);
  return sums;
}

}  // namespace beaconless
