// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/cell_loops.hpp"

#include <array>
#include <cstdint>

namespace beaconless {
namespace {

/// A step along a side of a cell, which lies to its left. Directions count counter-clockwise from +x.
struct Crack {
  Cell cell;
  int direction;

  friend bool operator==(const Crack&, const Crack&) = default;
};

constexpr std::array<int, 4> kStepX = {1, 0, -1, 0};
constexpr std::array<int, 4> kStepY = {0, 1, 0, -1};

Cell moved(Cell cell, int direction) {
  const auto d = static_cast<std::size_t>(direction);
  return {cell.x + kStepX[d], cell.y + kStepY[d]};
}

int turned(int direction, int quarters) { return (direction + quarters) & 3; }

/// Whether a grid is as large as it says.
bool has_all_cells(const OccupancyGrid& grid) {
  return grid.width_cells > 0 && grid.height_cells > 0 &&
         grid.occupancy_percent.size() ==
             static_cast<std::size_t>(grid.width_cells) * static_cast<std::size_t>(grid.height_cells);
}

/// The cell on the other side of a crack.
Cell beyond(const Crack& crack) { return moved(crack.cell, turned(crack.direction, 3)); }

/// The next crack of the same border: it turns right where a cell hangs on by a corner, goes on where the
/// next cell goes on, and else turns left around its own.
Crack next(const OccupancyGrid& grid, const Crack& crack) {
  const Cell ahead = moved(crack.cell, crack.direction);
  const Cell ahead_right = moved(beyond(crack), crack.direction);
  if (grid.is_occupied(ahead_right)) return {ahead_right, turned(crack.direction, 3)};
  if (grid.is_occupied(ahead)) return {ahead, crack.direction};
  return {crack.cell, turned(crack.direction, 1)};
}

}  // namespace

std::vector<std::vector<Cell>> find_cell_loops(const OccupancyGrid& grid) {
  std::vector<std::vector<Cell>> loops;
  if (!has_all_cells(grid)) return loops;
  std::vector<std::uint8_t> seen(grid.occupancy_percent.size(), 0);  // a bit a side
  for (int y = 0; y < grid.height_cells; ++y)
    for (int x = 0; x < grid.width_cells; ++x) {
      // Every border has a lower side of some cell.
      const Crack first{{x, y}, 0};
      if (!grid.is_occupied(first.cell) || grid.is_occupied(beyond(first))) continue;
      if ((seen[grid.index(first.cell)] & 1U) != 0) continue;
      std::vector<Cell>& loop = loops.emplace_back();
      Crack crack = first;
      do {
        seen[grid.index(crack.cell)] |=
            static_cast<std::uint8_t>(1U << static_cast<unsigned>(crack.direction));
        if (loop.empty() || !(loop.back() == crack.cell)) loop.push_back(crack.cell);
        crack = next(grid, crack);
      } while (!(crack == first));
      if (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
    }
  return loops;
}

}  // namespace beaconless
