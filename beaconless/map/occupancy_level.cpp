// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/occupancy_level.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace beaconless {
namespace {

constexpr int kSpare_cells = 32;

/// Where in a word a cell's value stands: its own, and those for which the word's cell is to the left, below,
/// …
constexpr int kOwn = 0;
constexpr int kRight = 8;
constexpr int kUpper = 16;
constexpr int kUpperRight = 24;

constexpr std::uint32_t kAllUnknown = 0xffffffffU;

}  // namespace

OccupancyLevel::OccupancyLevel(double resolution_m, const Pose2& map_from_grid)
    : resolution_m_(resolution_m), map_from_grid_(map_from_grid), stencils_(9, kAllUnknown) {}

std::size_t OccupancyLevel::place(Cell cell) const {
  return static_cast<std::size_t>(std::int64_t{cell.y} - low_.y + 2) * static_cast<std::size_t>(stride()) +
         static_cast<std::size_t>(std::int64_t{cell.x} - low_.x + 2);
}

std::uint8_t OccupancyLevel::byte(Cell cell) const {
  return has_room(cell) ? static_cast<std::uint8_t>(stencils_[place(cell)]) : kUnknown;
}

bool OccupancyLevel::is_near_obstacle(Cell cell) const {
  if (cell.x < low_.x - 1 || cell.y < low_.y - 1 || cell.x > high_.x || cell.y > high_.y) return false;
  const std::uint32_t four = stencils_[place(cell)];
  for (const int shift : {kOwn, kRight, kUpper, kUpperRight}) {
    const std::uint32_t value = (four >> shift) & 0xffU;
    if (value != 0 && value != kUnknown) return true;
  }
  return false;
}

void OccupancyLevel::put(Cell cell, std::uint8_t value) {
  if (!has_room(cell)) return;
  const auto write = [&](std::size_t word, int shift) {
    stencils_[word] = (stencils_[word] & ~(0xffU << shift)) | (std::uint32_t{value} << shift);
  };
  const std::size_t own = place(cell);
  const auto row = static_cast<std::size_t>(stride());
  write(own, kOwn);
  write(own - 1, kRight);
  write(own - row, kUpper);
  write(own - row - 1, kUpperRight);
}

Result<Done> OccupancyLevel::cover(Cell low, Cell high) {
  if (high.x < low.x || high.y < low.y || (has_room(low) && has_room(high))) return Done{};
  // 1. What is asked for, and what there is.
  const bool was_empty = high_.x < low_.x;
  Cell new_low = low;
  Cell new_high = high;
  if (!was_empty) {
    new_low = {std::min(low.x, low_.x), std::min(low.y, low_.y)};
    new_high = {std::max(high.x, high_.x), std::max(high.y, high_.y)};
  }
  const std::int64_t width = std::int64_t{new_high.x} - new_low.x + 1;
  const std::int64_t height = std::int64_t{new_high.y} - new_low.y + 1;
  if (width > kMaxCells || height > kMaxCells || width * height > kMaxCells)
    return Error{"OccupancyLevel",
                 "the grid would have " + std::to_string(width) + " x " + std::to_string(height) + " cells",
                 "at most " + std::to_string(kMaxCells) + " in all: raise resolution_m or check the poses"};
  // 2. Room to spare on the sides that moved, so that a level which grows with a drive is copied only a few
  // times.
  if (!was_empty) {
    const auto spare_x = static_cast<int>(kSpare_cells + width / 4);
    const auto spare_y = static_cast<int>(kSpare_cells + height / 4);
    if ((width + std::int64_t{2} * spare_x) * (height + std::int64_t{2} * spare_y) <= kMaxCells) {
      if (new_low.x < low_.x) new_low.x -= spare_x;
      if (new_low.y < low_.y) new_low.y -= spare_y;
      if (new_high.x > high_.x) new_high.x += spare_x;
      if (new_high.y > high_.y) new_high.y += spare_y;
    }
  }
  // 3. Copy. The words of the old rim are about known cells too, and have their place in the new one.
  OccupancyLevel larger(resolution_m_, map_from_grid_);
  larger.low_ = new_low;
  larger.high_ = new_high;
  larger.stencils_.assign(static_cast<std::size_t>(larger.stride()) * static_cast<std::size_t>(larger.rows()),
                          kAllUnknown);
  if (!was_empty) {
    for (int row = 0; row < rows(); ++row) {
      const auto from = stencils_.begin() + std::int64_t{row} * stride();
      std::copy(from, from + stride(),
                larger.stencils_.begin() + (std::int64_t{row} + low_.y - new_low.y) * larger.stride() +
                    (low_.x - new_low.x));
    }
  }
  *this = std::move(larger);
  return Done{};
}

OccupancyLevel::Sample OccupancyLevel::sample(const Eigen::Vector2d& point_map) const {
  // Cell (i, j) has its middle at (i + 1/2, j + 1/2).
  const Eigen::Vector2d point =
      map_from_grid_.inverse() * point_map / resolution_m_ - Eigen::Vector2d(0.5, 0.5);
  if (!(point.cwiseAbs().maxCoeff() < 1e9)) return {};
  const Cell cell{static_cast<int>(std::floor(point.x())), static_cast<int>(std::floor(point.y()))};
  const double fx = point.x() - cell.x;
  const double fy = point.y() - cell.y;
  const double m00 = value(cell);
  const double m10 = value({cell.x + 1, cell.y});
  const double m01 = value({cell.x, cell.y + 1});
  const double m11 = value({cell.x + 1, cell.y + 1});
  const Eigen::Vector2d slope((1.0 - fy) * (m10 - m00) + fy * (m11 - m01),
                              (1.0 - fx) * (m01 - m00) + fx * (m11 - m10));
  return {(1.0 - fy) * ((1.0 - fx) * m00 + fx * m10) + fy * ((1.0 - fx) * m01 + fx * m11),
          map_from_grid_.rotation() * slope / resolution_m_};
}

}  // namespace beaconless
