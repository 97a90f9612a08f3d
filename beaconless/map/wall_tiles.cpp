// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/wall_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace beaconless {
namespace {

constexpr double kRounding_m = 1e-5;

double square_of_distance(const WallIndex::Wall& wall, const Eigen::Vector2d& point) {
  const Eigen::Vector2d from = point - wall.a;
  const double along = std::clamp(wall.along.dot(from), 0.0, wall.length_m);
  return (from - along * wall.along).squaredNorm();
}

}  // namespace

std::uint32_t WallTiles::add(const Eigen::Vector2d& center, std::span<const std::uint32_t> walls) {
  lists_here_.clear();
  keep_candidates(center, static_cast<double>(kSide) * cell_m_, walls, kept_[0]);
  if (kept_[0].empty()) return 0;
  divide(center, 0, 0, kSide, kept_[0], 1);
  const auto first = static_cast<std::uint32_t>(cells.size());
  const bool is_one = lists_here_.size() == 1 && std::all_of(places_.begin(), places_.end(), [&](auto place) {
                        return place == places_.front();
                      });
  if (is_one) {
    cells.push_back(places_.front());
    return 2 * first;
  }
  cells.insert(cells.end(), places_.begin(), places_.end());
  return 2 * first + 1;
}

void WallTiles::divide(const Eigen::Vector2d& center, std::size_t column, std::size_t row, std::size_t side,
                       std::span<const std::uint32_t> walls, std::size_t level) {
  if (side == 1 || walls.size() <= 1) {
    const std::uint32_t place = list_of(walls);
    for (std::size_t y = row; y < row + side; ++y)
      for (std::size_t x = column; x < column + side; ++x) places_[kSide * y + x] = place;
    return;
  }
  const std::size_t half = side / 2;
  const double half_m = static_cast<double>(half) * cell_m_;
  for (const std::size_t y : {0U, 1U})
    for (const std::size_t x : {0U, 1U}) {
      const Eigen::Vector2d middle =
          center + half_m * Eigen::Vector2d(static_cast<double>(x) - 0.5, static_cast<double>(y) - 0.5);
      keep_candidates(middle, half_m, walls, kept_[level]);
      divide(middle, column + x * half, row + y * half, half, kept_[level], level + 1);
    }
}

/// Any point of a square is within half a diagonal of its center, so a wall can be nearest to it only when it
/// is within a whole diagonal of being nearest to the center.
void WallTiles::keep_candidates(const Eigen::Vector2d& center, double side_m,
                                std::span<const std::uint32_t> walls, std::vector<std::uint32_t>& kept) {
  kept.clear();
  squares_m2_.clear();
  double least_m2 = std::numeric_limits<double>::infinity();
  for (const std::uint32_t id : walls) {
    squares_m2_.push_back(square_of_distance(walls_[id], center));
    least_m2 = std::min(least_m2, squares_m2_.back());
  }
  const double diagonal_m = std::numbers::sqrt2 * side_m;
  const double most_m = std::min(std::sqrt(least_m2) + diagonal_m, reach_m_ + 0.5 * diagonal_m) + kRounding_m;
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (squares_m2_[i] <= most_m * most_m) kept.push_back(walls[i]);
}

/// Where a list is, written down if no other cell of the tile has it.
std::uint32_t WallTiles::list_of(std::span<const std::uint32_t> walls) {
  if (walls.empty()) return 0;
  for (std::size_t i = lists_here_.size(); i-- > 0;) {
    const std::uint32_t* const list = lists.data() + lists_here_[i];
    if (list[0] == walls.size() && std::equal(walls.begin(), walls.end(), list + 1)) return lists_here_[i];
  }
  lists_here_.push_back(static_cast<std::uint32_t>(lists.size()));
  lists.push_back(static_cast<std::uint32_t>(walls.size()));
  lists.insert(lists.end(), walls.begin(), walls.end());
  return lists_here_.back();
}

}  // namespace beaconless
