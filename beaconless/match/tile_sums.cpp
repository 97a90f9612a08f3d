// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/tile_sums.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace beaconless {

namespace {

// Two bytes at a time in 16 bits, so that sums have room without any of the bytes being moved.
using Words = std::uint16_t __attribute__((vector_size(NearnessPyramid::kTileColumns)));
using Rows = std::array<Words, NearnessPyramid::kTileRows>;

constexpr std::size_t kAtOnce = 24;  // cells, before it is asked whether there is any use in going on

int greatest(const Rows& low, const Rows& high) {
  Words most{};
  for (const Rows* half : {&low, &high})
    for (const Words& row : *half) most = row > most ? row : most;
  std::uint16_t greatest = 0;
  for (std::size_t i = 0; i < NearnessPyramid::kTileColumns / 2; ++i)
    greatest = std::max(greatest, static_cast<std::uint16_t>(most[i]));
  return greatest;
}

void add_tiles(const NearnessPyramid& map, int level, std::span<const Cell> cells, int x, int y, Rows& low,
               Rows& high) {
  constexpr int kByte = 8;
  constexpr std::uint16_t kLow = 0xff;
  const std::size_t pitch = map.pitch(level);
  Rows low_sum = low;
  Rows high_sum = high;
  for (const Cell& cell : cells) {
    const std::uint8_t* from = map.tile(level, {cell.x + x, cell.y + y});
    if (from == nullptr) continue;
    for (std::size_t row = 0; row < NearnessPyramid::kTileRows; ++row, from += pitch) {
      Words bytes;
      std::memcpy(&bytes, from, sizeof(bytes));
      low_sum[row] += bytes & kLow;
      high_sum[row] += bytes >> kByte;
    }
  }
  low = low_sum;
  high = high_sum;
}

}  // namespace

TileSums sum_tiles(const NearnessPyramid& map, int level, std::span<const Cell> cells, int x, int y,
                   int least) {
  Rows low{};
  Rows high{};
  while (!cells.empty()) {
    const std::size_t count = std::min(cells.size(), kAtOnce);
    add_tiles(map, level, cells.first(count), x, y, low, high);
    cells = cells.subspan(count);
    // Were all that are left on a surface, it would still not do.
    if (greatest(low, high) + NearnessPyramid::kOnSurface * static_cast<int>(cells.size()) < least) return {};
  }
  if constexpr (std::endian::native == std::endian::big) std::swap(low, high);
  TileSums sums;
  static_assert(sizeof(sums.even) == sizeof(low));
  std::memcpy(&sums.even, &low, sizeof(low));
  std::memcpy(&sums.odd, &high, sizeof(high));
  return sums;
}

}  // namespace beaconless
