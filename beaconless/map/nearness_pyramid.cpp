// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/nearness_pyramid.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

/// For every position of a window of `count` values in a row of `length`, beginning with the one of which
/// only the last value is inside, the greatest in it. Cost: count comparisons each.
void widen(const std::uint8_t* from, std::size_t stride, int length, int count, std::uint8_t* to) {
  for (int first = 1 - count; first < length; ++first, to += stride) {
    std::uint8_t greatest = 0;
    for (int i = std::max(0, first); i < std::min(length, first + count); ++i)
      greatest = std::max(greatest, from[static_cast<std::size_t>(i) * stride]);
    *to = greatest;
  }
}

std::uint8_t nearness(const std::optional<SurfacePoint>& surface, double truncate_m) {
  if (!surface) return 0;
  const double share = surface->distance_m / truncate_m;
  return static_cast<std::uint8_t>(
      std::lround(NearnessPyramid::kOnSurface * std::max(0.0, 1.0 - share * share)));
}

}  // namespace

NearnessPyramid::NearnessPyramid(const SurfaceMap& map, double cell_m, double truncate_m) : cell_m_(cell_m) {
  const FloorPlan::Bounds bounds = bounds_of(map);
  const Eigen::Vector2d inner = bounds.high - bounds.low;
  cell_m_ = std::max(cell_m_,
                     std::sqrt((inner.x() + 2.0 * truncate_m) * (inner.y() + 2.0 * truncate_m) / kMaxCells));
  const double none_m = std::max(truncate_m, 2.0 * cell_m_);
  low_ = bounds.low.array() - none_m;
  const Eigen::Vector2d extent = inner.array() + 2.0 * none_m;
  width_ = static_cast<int>(std::ceil(extent.x() / cell_m_));
  height_ = static_cast<int>(std::ceil(extent.y() / cell_m_));
  std::vector<std::uint8_t> finest;
  finest.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  std::visit(
      [&](const auto& index) {
        for (int y = 0; y < height_; ++y)
          for (int x = 0; x < width_; ++x)
            finest.push_back(
                nearness(index.nearest(low_ + cell_m_ * Eigen::Vector2d(x + 0.5, y + 0.5)), none_m));
      },
      map);
  for (int level = 0; level < kLevels; ++level)
    levels_[static_cast<std::size_t>(level)] = make_level(level, finest);
}

NearnessPyramid::Level NearnessPyramid::make_level(int level, const std::vector<std::uint8_t>& finest) const {
  // 1. The greatest in the block at every cell: first along the rows, then along the columns.
  const int block = block_cells(level);
  const auto width = static_cast<std::size_t>(width_);
  const auto wide = static_cast<std::size_t>(width_ + block - 1);
  std::vector<std::uint8_t> rows(wide * static_cast<std::size_t>(height_));
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y)
    widen(finest.data() + y * width, 1, width_, block, rows.data() + y * wide);
  std::vector<std::uint8_t> blocks(wide * static_cast<std::size_t>(height_ + block - 1));
  for (std::size_t x = 0; x < wide; ++x) widen(rows.data() + x, wide, height_, block, blocks.data() + x);
  // 2. Sorted by phase.
  const int shift = 2 * level;
  Level made;
  made.pitch = static_cast<unsigned>(kLeft + ((width_ - 1) >> shift) + 1);
  made.filled_rows = static_cast<unsigned>(kBelow + ((height_ - 1) >> shift) + 1);
  made.rows = made.filled_rows + kTileRows;
  made.bytes.assign(std::size_t{made.pitch} * made.rows * static_cast<std::size_t>(block * block) + kLeft, 0);
  const std::uint8_t* from = blocks.data();
  for (int y = 1 - block; y < height_; ++y)
    for (int x = 1 - block; x < width_; ++x) {
      const auto phase = static_cast<std::size_t>(((y & (block - 1)) << shift) | (x & (block - 1)));
      const int row = (y >> shift) + kBelow;
      const int column = (x >> shift) + kLeft;
      made.bytes[(phase * made.rows + static_cast<std::size_t>(row)) * made.pitch +
                 static_cast<std::size_t>(column)] = *from++;
    }
  return made;
}

std::size_t NearnessPyramid::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += level.bytes.size();
  return sum;
}

}  // namespace beaconless
