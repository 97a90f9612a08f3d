// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/grid_traversal.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

using CellSet = std::set<std::pair<int, int>>;

std::vector<Cell> traversed(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  std::vector<Cell> cells;
  traverse_cells(from, to, [&](Cell cell) { cells.push_back(cell); });
  return cells;
}

std::vector<Cell> bresenham(Cell from, Cell to) {
  std::vector<Cell> cells;
  bresenham_cells(from, to, [&](Cell cell) { cells.push_back(cell); });
  return cells;
}

CellSet as_set(const std::vector<Cell>& cells) {
  CellSet set;
  for (const Cell& cell : cells) set.insert({cell.x, cell.y});
  return set;
}

Eigen::Vector2d random_point(Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size)};
}

Cell random_cell(Rng& rng) { return cell_of(random_point(rng, 30.0)); }

TEST(TraverseCells, VisitsEachCellOnceFromEndToEndBySides) {
  Rng rng(1);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector2d from = random_point(rng, 40.0);
    const Eigen::Vector2d to =
        i % 5 == 0 ? Eigen::Vector2d(from.x(), rng.uniform(-40.0, 40.0)) : random_point(rng, 40.0);
    const auto cells = traversed(from, to);
    EXPECT_EQ(cells.front(), cell_of(from));
    EXPECT_EQ(cells.back(), cell_of(to));
    const int steps = std::abs(cells.back().x - cells.front().x) + std::abs(cells.back().y - cells.front().y);
    EXPECT_EQ(cells.size(), static_cast<std::size_t>(steps + 1));
    EXPECT_EQ(as_set(cells).size(), cells.size());
    for (std::size_t k = 1; k < cells.size(); ++k)
      EXPECT_EQ(std::abs(cells[k].x - cells[k - 1].x) + std::abs(cells[k].y - cells[k - 1].y), 1);
  }
}

// The slow twin: points along the way, closely spaced; each lies in a visited cell, and each visited cell
// holds a piece of the way (its corners do not all lie strictly on one side).
TEST(TraverseCells, VisitsWhatTheWayCrossesAndNothingElse) {
  Rng rng(2);
  constexpr double kRounding = 1e-9;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d from = random_point(rng, 20.0);
    const Eigen::Vector2d to = random_point(rng, 20.0);
    const auto cells = traversed(from, to);
    const CellSet visited = as_set(cells);
    for (int k = 0; k <= 2000; ++k) {
      const Cell cell = cell_of(from + (k / 2000.0) * (to - from));
      EXPECT_TRUE(visited.contains({cell.x, cell.y})) << cell.x << " " << cell.y;
    }
    const Eigen::Vector2d along = (to - from).normalized();
    for (const Cell& cell : cells) {
      double low = 1e9;
      double high = -1e9;
      for (const int corner : {0, 1, 2, 3}) {
        const Eigen::Vector2d p = Eigen::Vector2d(cell.x + (corner & 1), cell.y + (corner >> 1)) - from;
        const double side = along.x() * p.y() - along.y() * p.x();
        low = std::min(low, side);
        high = std::max(high, side);
      }
      EXPECT_LE(low, kRounding);
      EXPECT_GE(high, -kRounding);
    }
  }
}

TEST(TraverseCells, TheWayBackVisitsTheSameCells) {
  Rng rng(3);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector2d from = random_point(rng, 40.0);
    const Eigen::Vector2d to = random_point(rng, 40.0);
    EXPECT_EQ(as_set(traversed(from, to)), as_set(traversed(to, from)));
  }
}

TEST(TraverseCells, TheWayBackThroughCornersVisitsTheSameCells) {
  for (const int sign_x : {-1, 1}) {
    for (const int sign_y : {-1, 1}) {
      const Eigen::Vector2d from(0.5, 0.5);
      const Eigen::Vector2d to(0.5 + 4 * sign_x, 0.5 + 4 * sign_y);
      const auto cells = traversed(from, to);
      EXPECT_EQ(cells.size(), 9U);
      EXPECT_EQ(as_set(cells), as_set(traversed(to, from)));
    }
  }
}

TEST(TraverseCells, EndsAlsoOnBordersCornersAndAtNoLength) {
  EXPECT_EQ(traversed({0.5, 0.5}, {0.5, 0.5}), (std::vector<Cell>{{0, 0}}));
  EXPECT_EQ(traversed({0.0, 0.0}, {3.0, 0.0}), (std::vector<Cell>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(traversed({3.0, 0.0}, {0.0, 0.0}), (std::vector<Cell>{{3, 0}, {2, 0}, {1, 0}, {0, 0}}));
  EXPECT_EQ(traversed({2.0, 2.0}, {0.0, 0.0}).back(), (Cell{0, 0}));
  EXPECT_EQ(traversed({-1.0, 2.0}, {-1.0, -2.0}).back(), (Cell{-1, -2}));
}

TEST(BresenhamCells, EndsWhereThePrintedAlgorithmDoesNot) {
  // With 2 dy added only where y does not step, these end at (4, 1), (7, 4) and (20, 6).
  for (const Cell& end : {Cell{4, 2}, Cell{7, 7}, Cell{20, 9}}) EXPECT_EQ(bresenham({0, 0}, end).back(), end);
}

TEST(BresenhamCells, TakesTheLongerSidesCountOfCellsInAllOctants) {
  Rng rng(4);
  for (int i = 0; i < 3000; ++i) {
    const Cell from = random_cell(rng);
    const Cell to = random_cell(rng);
    const auto cells = bresenham(from, to);
    const int longer = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(longer + 1));
    EXPECT_EQ(cells.front(), from);
    EXPECT_EQ(cells.back(), to);
    for (std::size_t k = 1; k < cells.size(); ++k)
      EXPECT_EQ(std::max(std::abs(cells[k].x - cells[k - 1].x), std::abs(cells[k].y - cells[k - 1].y)), 1);
  }
}

TEST(BresenhamCells, StaysWithinHalfACellOfTheLine) {
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const Cell from = random_cell(rng);
    const Cell to = random_cell(rng);
    const std::int64_t dx = to.x - from.x;
    const std::int64_t dy = to.y - from.y;
    const std::int64_t longer = std::max(std::abs(dx), std::abs(dy));
    for (const Cell& cell :
         bresenham(from, to))  // |cross product| / longer side: the distance along the shorter axis
      EXPECT_LE(2 * std::abs(dx * (cell.y - from.y) - dy * (cell.x - from.x)),
                longer * longer > 0 ? longer : 0);
  }
}

TEST(BresenhamCells, IsASubsetOfTheExactCellsBetweenTheSameMiddles) {
  Rng rng(6);
  for (int i = 0; i < 1000; ++i) {
    const Cell from = random_cell(rng);
    const Cell to = random_cell(rng);
    const CellSet exact = as_set(traversed({from.x + 0.5, from.y + 0.5}, {to.x + 0.5, to.y + 0.5}));
    for (const Cell& cell : bresenham(from, to)) EXPECT_TRUE(exact.contains({cell.x, cell.y}));
  }
}

}  // namespace
}  // namespace beaconless
