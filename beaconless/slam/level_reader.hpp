// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "beaconless/map/occupancy_level.hpp"

namespace beaconless {

/// Reads cells of a level in loops over many: without a call, by the words that the matcher reads too. Good
/// until the level changes.
class LevelReader {
 public:
  explicit LevelReader(const OccupancyLevel& level)
      : words_(level.stencils().data()),
        first_{level.low().x - 2, level.low().y - 2},
        width_(static_cast<std::uint32_t>(level.stride())),
        height_(static_cast<std::uint32_t>(level.rows())) {}

  /// Steps of 1/254 of a cell and, in the higher bytes, of its right, upper and upper right neighbour;
  /// OccupancyLevel::kUnknown where nothing is known.
  std::uint32_t word(Cell cell) const {
    const auto x = static_cast<std::uint32_t>(cell.x) - static_cast<std::uint32_t>(first_.x);
    const auto y = static_cast<std::uint32_t>(cell.y) - static_cast<std::uint32_t>(first_.y);
    if (x >= width_ || y >= height_) return 0xffffffffU;
    return words_[std::size_t{y} * width_ + x];
  }
  std::uint8_t byte(Cell cell) const { return static_cast<std::uint8_t>(word(cell)); }

 private:
  const std::uint32_t* words_;
  Cell first_;
  std::uint32_t width_;
  std::uint32_t height_;
};

}  // namespace beaconless
