// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/tile_sums.hpp"

#include <bit>
#include <cstring>
#include <utility>

namespace beaconless {

TileSums sum_tiles(const NearnessPyramid& map, int level, std::span<const Cell> cells, int x, int y) {
  // Two bytes at a time in 16 bits, so that sums have room without any of the bytes being moved.
  using Words = std::uint16_t __attribute__((vector_size(NearnessPyramid::kTileColumns)));
  constexpr int kByte = 8;
  constexpr std::uint16_t kLow = 0xff;
  const std::size_t pitch = map.pitch(level);
  std::array<Words, NearnessPyramid::kTileRows> low{};
  std::array<Words, NearnessPyramid::kTileRows> high{};
  for (const Cell& cell : cells) {
    const std::uint8_t* from = map.tile(level, {cell.x + x, cell.y + y});
    if (from == nullptr) continue;
    for (std::size_t row = 0; row < NearnessPyramid::kTileRows; ++row, from += pitch) {
      Words bytes;
      std::memcpy(&bytes, from, sizeof(bytes));
      low[row] += bytes & kLow;
      high[row] += bytes >> kByte;
    }
  }
  if constexpr (std::endian::native == std::endian::big) std::swap(low, high);
  TileSums sums;
  static_assert(sizeof(sums.even) == sizeof(low));
  std::memcpy(&sums.even, &low, sizeof(low));
  std::memcpy(&sums.odd, &high, sizeof(high));
  return sums;
}

}  // namespace beaconless
