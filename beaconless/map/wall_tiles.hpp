// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/wall_index.hpp"

namespace beaconless {

/// Divides a tile into quarters and those again, down to its cells, and writes down which walls can be
/// nearest in each.
///
/// A wall that is no candidate of a square is none of any square in it, so that only the few of a quarter are
/// looked at within it; a quarter with one candidate is not divided any more. Cost: some hundred distances a
/// tile beside walls. Source: the rule of WallIndex; point location in a quadtree.
class WallTiles {
 public:
  static constexpr std::size_t kSide = 8;  ///< cells along each side of a tile

  /// In: walls that outlive it; lists that may be shared from tile to tile begin with an empty one.
  WallTiles(const std::vector<WallIndex::Wall>& walls, double reach_m, double cell_m)
      : walls_(walls), reach_m_(reach_m), cell_m_(cell_m) {}

  /// Adds a tile that these walls may be near to, and gives twice its first cell, plus 1 if it is divided.
  std::uint32_t add(const Eigen::Vector2d& center, std::span<const std::uint32_t> walls);

  std::vector<std::uint32_t> cells{0};  ///< where in `lists` the list of each begins
  std::vector<std::uint32_t> lists{0};  ///< how many walls, then which; the first is empty

 private:
  void divide(const Eigen::Vector2d& center, std::size_t column, std::size_t row, std::size_t side,
              std::span<const std::uint32_t> walls, std::size_t level);
  void keep_candidates(const Eigen::Vector2d& center, double side_m, std::span<const std::uint32_t> walls,
                       std::vector<std::uint32_t>& kept);
  std::uint32_t list_of(std::span<const std::uint32_t> walls);

  const std::vector<WallIndex::Wall>& walls_;
  double reach_m_;
  double cell_m_;
  std::vector<double> squares_m2_;
  std::array<std::vector<std::uint32_t>, 4> kept_;     // of the square of each size that is being divided
  std::array<std::uint32_t, kSide * kSide> places_{};  // in lists, of the cells
  std::vector<std::uint32_t> lists_here_;
};

}  // namespace beaconless
