// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/grid_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/rasterize.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/cell_loops.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// A grid as drawn: '#' is occupied, '.' free, '?' unknown; the last row is the lowest.
OccupancyGrid drawn(const std::vector<std::string>& rows, double resolution_m = 1.0) {
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.width_cells = static_cast<int>(rows.front().size());
  grid.height_cells = static_cast<int>(rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char cell : *row)
      grid.occupancy_percent.push_back(cell == '#'   ? OccupancyGrid::kOccupied
                                       : cell == '.' ? OccupancyGrid::kFree
                                                     : OccupancyGrid::kUnknown);
  return grid;
}

/// The distance from the nearest outline.
double distance_m(const FloorPlan& plan, const Eigen::Vector2d& point) {
  double least = 1e9;
  for (const Segment2& wall : plan.segments()) least = std::min(least, wall.distance_m(point));
  return least;
}

std::set<std::pair<int, int>> cells_of(const std::vector<std::vector<Cell>>& loops) {
  std::set<std::pair<int, int>> cells;
  for (const auto& loop : loops)
    for (const Cell& cell : loop) cells.insert({cell.x, cell.y});
  return cells;
}

TEST(CellLoops, PassEveryCellThatHasAFreeSideAndNoOther) {
  Rng rng(2);
  for (const double share : {0.05, 0.3, 0.5, 0.7, 0.95}) {
    OccupancyGrid grid;
    grid.width_cells = 40;
    grid.height_cells = 30;
    for (int i = 0; i < 1200; ++i)
      grid.occupancy_percent.push_back(rng.uniform() < share ? OccupancyGrid::kOccupied
                                                             : OccupancyGrid::kUnknown);
    std::set<std::pair<int, int>> expected;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        if (grid.is_occupied({x, y}) && !(grid.is_occupied({x - 1, y}) && grid.is_occupied({x + 1, y}) &&
                                          grid.is_occupied({x, y - 1}) && grid.is_occupied({x, y + 1})))
          expected.insert({x, y});
    const auto loops = find_cell_loops(grid);
    EXPECT_EQ(cells_of(loops), expected);
    for (const auto& loop : loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Cell a = loop[i];
        const Cell b = loop[i + 1 < loop.size() ? i + 1 : 0];
        EXPECT_LE(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1);  // neighbours, if by a corner
      }
  }
}

TEST(CellLoops, GoAroundAndInside) {
  EXPECT_TRUE(find_cell_loops(drawn({"...", "..."})).empty());
  const auto ring = find_cell_loops(drawn({"####", "#..#", "####"}));
  ASSERT_EQ(ring.size(), 2U);  // without and within
  EXPECT_EQ(ring[0].size(), 10U);
  EXPECT_EQ(find_cell_loops(drawn({"#.#", ".#.", "#.#"})).size(), 1U);  // corners hang together
  EXPECT_EQ(find_cell_loops(drawn({"#.#"})).size(), 2U);
}

TEST(GridOutlines, ARectangleHasItsCorners) {
  const FloorPlan plan = outlines_of(drawn({"##########", "##########", "##########", "##########"}, 0.1));
  ASSERT_EQ(plan.walls.size(), 1U);
  ASSERT_EQ(plan.walls[0].size(), 5U);
  EXPECT_EQ(plan.walls[0].front(), plan.walls[0].back());
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0.05, 0.05), Eigen::Vector2d(0.95, 0.05),
                                        Eigen::Vector2d(0.95, 0.35), Eigen::Vector2d(0.05, 0.35)})
    EXPECT_TRUE(std::any_of(plan.walls[0].begin(), plan.walls[0].end(),
                            [&](const auto& point) { return (point - corner).norm() < 1e-9; }));
}

TEST(GridOutlines, SmallThingsStay) {
  const FloorPlan cell = outlines_of(drawn({"...", ".#.", "..."}));
  ASSERT_EQ(cell.segments().size(), 4U);  // a square on edge
  EXPECT_NEAR(distance_m(cell, {1.5, 1.5}), std::sqrt(0.125), 1e-9);
  const FloorPlan two = outlines_of(drawn({"....", ".##.", "...."}));
  EXPECT_NEAR(distance_m(two, {2.0, 1.5}), 0.0, 1e-9);
  EXPECT_FALSE(two.segments().empty());
  const FloorPlan square = outlines_of(drawn({"##", "##"}));
  EXPECT_EQ(square.segments().size(), 4U);
  const FloorPlan pillar = outlines_of(drawn({"###", "###", "###"}));
  EXPECT_EQ(pillar.segments().size(), 4U);
}

TEST(GridOutlines, NothingIsSeenThroughAnObliqueWall) {
  // Cells of a thin wall touch by their corners only.
  const RayCaster rays(outlines_of(drawn({"#....", ".#...", "..#..", "...#.", "....#"})).segments());
  for (double s = 0.7; s < 4.3; s += 0.01) {
    const Eigen::Vector2d from(s - 1.0, 5.0 - s - 1.0);
    EXPECT_TRUE(rays.cast(from, Eigen::Vector2d(1.0, 1.0).normalized(), 3.0)) << s;
  }
}

TEST(GridOutlines, OfNothingAreNone) {
  EXPECT_TRUE(outlines_of(OccupancyGrid{}).walls.empty());
  EXPECT_TRUE(outlines_of(drawn({"..?", "?.."})).walls.empty());
  EXPECT_EQ(outlines_of(drawn({"###", "###"})).walls.size(), 1U);  // up to the border of the grid
}

TEST(GridOutlines, TurnWithTheGrid) {
  OccupancyGrid grid = drawn({"......", ".####.", ".#..#.", ".#..#.", ".####.", "......"}, 0.05);
  const FloorPlan plan = outlines_of(grid);
  grid.map_from_grid = {3.0, -2.0, 0.7};
  const FloorPlan turned = outlines_of(grid);
  ASSERT_EQ(turned.walls.size(), plan.walls.size());
  for (std::size_t w = 0; w < plan.walls.size(); ++w)
    for (std::size_t i = 0; i < plan.walls[w].size(); ++i)
      EXPECT_LT((turned.walls[w][i] - grid.map_from_grid * plan.walls[w][i]).norm(), 1e-12);
}

/// The points on a plan's walls that are at least `from_corner_m` from their ends.
std::vector<Eigen::Vector2d> along_walls(const FloorPlan& plan, double from_corner_m) {
  std::vector<Eigen::Vector2d> points;
  for (const Segment2& wall : plan.segments())
    for (double s = from_corner_m; s < wall.length_m() - from_corner_m; s += 0.02)
      points.emplace_back(wall.a + s * (wall.b - wall.a).normalized());
  return points;
}

TEST(GridOutlines, LieOnTheWallsThatWereDrawn) {
  // Every cell that a wall passes through is occupied; where the wall runs oblique to the cells, the
  // outline's root mean square distance from it is a small part of one, and along them at most half of one.
  const FloorPlan room = test::niche_room();
  for (const double heading_deg : {0.0, 7.0, 23.0, 45.0})
    for (const double phase : {0.5, 0.3, 0.05}) {
      const OccupancyGrid grid = rasterize(room, {.resolution_m = 0.05,
                                                  .heading_rad = radians(heading_deg),
                                                  .phase_x_cells = phase,
                                                  .phase_y_cells = 1.0 - phase})
                                     .value();
      const FloorPlan outlines = outlines_of(grid);
      double square = 0.0;
      double most = 0.0;
      const auto points = along_walls(room, 0.1);
      for (const Eigen::Vector2d& point : points) {
        const double off = distance_m(outlines, point);
        square += off * off / static_cast<double>(points.size());
        most = std::max(most, off);
      }
      EXPECT_LT(std::sqrt(square), (heading_deg == 0.0 ? 0.5 : 0.3) * 0.05) << heading_deg << " " << phase;
      EXPECT_LT(most, 1.0 * 0.05) << heading_deg << " " << phase;
      // A few straight pieces, not a staircase: both sides of each of the twelve walls, and some to spare.
      EXPECT_LT(outlines.segments().size(), 60U) << heading_deg << " " << phase;
    }
}

TEST(GridOutlines, HaveCornersWhereTheyWereDrawn) {
  // Where walls run oblique to the cells, lines through many of them cross within a part of one from the
  // corner.
  const FloorPlan room = test::niche_room();
  for (const double heading_deg : {7.0, 23.0}) {
    const FloorPlan outlines =
        outlines_of(rasterize(room, {.resolution_m = 0.025, .heading_rad = radians(heading_deg)}).value());
    std::vector<double> off_cells;
    for (const FloorPlan::Polyline& wall : room.walls)
      for (const Eigen::Vector2d& corner : wall) {
        double least = 1e9;
        for (const FloorPlan::Polyline& outline : outlines.walls)
          for (const Eigen::Vector2d& point : outline) least = std::min(least, (point - corner).norm());
        off_cells.push_back(least / 0.025);
      }
    std::sort(off_cells.begin(), off_cells.end());
    EXPECT_LT(off_cells[off_cells.size() / 2], 0.3) << heading_deg;
    EXPECT_LT(off_cells.back(), 0.4) << heading_deg;
  }
}

/// A wall of 6 m along x, from the origin, with boxes that touch it or stand near it on both sides.
FloorPlan wall_with_boxes() {
  const auto box = [](double x, double y, double width, double depth) {
    return FloorPlan::Polyline{{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}, {x, y}};
  };
  return {.walls = {{{0.0, 0.0}, {6.0, 0.0}},
                    box(0.8, 0.06, 0.7, 0.4),
                    box(2.2, 0.0, 0.5, 0.5),
                    box(3.1, -0.4, 0.4, 0.34),
                    box(4.0, 0.05, 1.1, 0.45)}};
}

/// The pieces that lie along most of the wall of wall_with_boxes, within a cell.
std::vector<Segment2> along_the_wall(const FloorPlan& outlines) {
  std::vector<Segment2> found;
  for (const Segment2& wall : outlines.segments())
    if (wall.length_m() > 0.3 && std::abs(wall.a.y()) < 0.025 && std::abs(wall.b.y()) < 0.025)
      found.push_back(wall);
  return found;
}

TEST(ThinGridOutlines, AWallIsWholeBehindWhatStandsAgainstIt) {
  for (const double heading_deg : {7.0, -11.0, 23.0, 40.0})
    for (const double phase : {0.5, 0.2}) {
      const OccupancyGrid grid =
          rasterize(wall_with_boxes(),
                    {.resolution_m = 0.05, .heading_rad = radians(heading_deg), .phase_x_cells = phase})
              .value();
      const FloorPlan outlines = outlines_of(grid, {.thin_cells = 4});
      EXPECT_EQ(outlines.cell_m, 0.05);
      const std::vector<Segment2> found = along_the_wall(outlines);
      ASSERT_EQ(found.size(), 1U) << heading_deg << " " << phase;  // and not once for each side
      EXPECT_NEAR(found[0].length_m(), 6.0, 0.1) << heading_deg << " " << phase;
      for (double x = 0.1; x < 5.95; x += 0.1)
        EXPECT_LT(found[0].distance_m({x, 0.0}), 0.05 / 20.0) << heading_deg << " " << phase << " " << x;
    }
}

TEST(ThinGridOutlines, ThickThingsHaveTwoSides) {
  std::vector<std::string> rows(16, std::string(40, '.'));
  for (int y = 3; y < 9; ++y) rows[y].replace(5, 30, 30, '#');
  const OccupancyGrid grid = drawn(rows);
  const FloorPlan outlines = outlines_of(grid, {.thin_cells = 4});
  EXPECT_EQ(outlines.segments().size(), 4U);
  EXPECT_NEAR(distance_m(outlines, {20.0, 7.5}), 0.0, 1e-9);
  EXPECT_NEAR(distance_m(outlines, {20.0, 12.5}), 0.0, 1e-9);
  EXPECT_GT(distance_m(outlines, {20.0, 10.0}), 2.0);
}

TEST(ThinGridOutlines, AThinWallIsOneLineAndAPostIsNot) {
  const FloorPlan wall = outlines_of(
      drawn({"..............", ".############.", ".############.", ".............."}), {.thin_cells = 4});
  ASSERT_EQ(wall.segments().size(), 1U);
  EXPECT_NEAR(wall.segments()[0].a.y(), 2.0, 1e-9);
  EXPECT_NEAR(wall.segments()[0].b.y(), 2.0, 1e-9);
  const FloorPlan post = outlines_of(drawn({"....", ".##.", ".##.", "...."}), {.thin_cells = 4});
  EXPECT_EQ(post.segments().size(), 4U);
}

TEST(ThinGridOutlines, OnlyIfAskedFor) {
  const OccupancyGrid grid =
      rasterize(wall_with_boxes(), {.resolution_m = 0.05, .heading_rad = radians(7.0)}).value();
  const FloorPlan outlines = outlines_of(grid);
  EXPECT_EQ(outlines.cell_m, 0.0);
  EXPECT_EQ(outlines.walls.size(), find_cell_loops(grid).size());
  for (const FloorPlan::Polyline& wall : outlines.walls) EXPECT_EQ(wall.front(), wall.back());
  EXPECT_TRUE(outlines_of(OccupancyGrid{}, {.thin_cells = 4}).walls.empty());
}

TEST(ThinGridOutlines, AreOffByWhatTheIndexSays) {
  // A room at many places in the cells: its walls' offsets against the standard deviations that are claimed.
  Rng rng(3);
  for (const double heading_deg : {0.0, 7.0, 45.0}) {
    double square = 0.0;
    double claimed = 0.0;
    for (int i = 0; i < 40; ++i) {
      const FloorPlan room{.walls = {{{0.0, 0.0}, {5.0, 0.0}, {5.0, 4.0}, {0.0, 4.0}, {0.0, 0.0}}}};
      const OccupancyGrid grid = rasterize(room, {.resolution_m = 0.05,
                                                  .heading_rad = radians(heading_deg),
                                                  .phase_x_cells = rng.uniform(),
                                                  .phase_y_cells = rng.uniform()})
                                     .value();
      const WallIndex index(outlines_of(grid, {.thin_cells = 4}));
      for (std::uint32_t id = 0; id < index.wall_count(); ++id) {
        const WallIndex::Wall& wall = index.wall(id);
        if (wall.length_m < 3.0) continue;
        const Eigen::Vector2d middle = wall.a + 0.5 * wall.length_m * wall.along;
        square += std::pow(distance_m(room, middle), 2);
        claimed += wall.variance_m2;
      }
    }
    EXPECT_GT(square, 0.25 * claimed) << heading_deg;
    EXPECT_LT(square, 1.6 * claimed) << heading_deg;
  }
}

}  // namespace
}  // namespace beaconless
