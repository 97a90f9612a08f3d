// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/grid_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Beams a quarter turn apart, beginning to the right (-y), or as many as there are ranges, all around.
Scan scan_of(const std::vector<float>& ranges_m, float range_max_m = 100.0F) {
  RawScan raw;
  raw.angle_increment_rad = static_cast<float>(2.0 * kPi / static_cast<double>(ranges_m.size()));
  raw.angle_min_rad = -raw.angle_increment_rad;
  raw.range_max_m = range_max_m;
  raw.ranges_m = ranges_m;
  return Scan::make(std::move(raw)).value();
}

/// A sweep of 360 beams in a square room of 2 half_m a side, taken at its middle.
Scan square_room(float half_m) {
  std::vector<float> ranges;
  for (int i = 0; i < 360; ++i) {
    const double angle = radians(i - 1.0);
    ranges.push_back(half_m /
                     static_cast<float>(std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)))));
  }
  return scan_of(ranges);
}

GridBuilder builder_of(const GridBuilderConfig& config) { return GridBuilder::make(config).value(); }

int percent_at(const GridBuilder& builder, double x_m, double y_m) {
  const OccupancyGrid grid = builder.grid();
  return grid.at(grid.cell_at({x_m, y_m}));
}

TEST(GridBuilder, OneBeamMarksItsEndAndItsWay) {
  GridBuilder builder = builder_of({.resolution_m = 0.1});
  ASSERT_TRUE(builder.add(scan_of({kInfinity, 1.0F, kInfinity, kInfinity}), {0.05, 0.05, 0.0}));
  const OccupancyGrid grid = builder.grid();
  EXPECT_EQ(grid.width_cells, 11);
  EXPECT_EQ(grid.height_cells, 1);
  for (int x = 0; x < 10; ++x) EXPECT_EQ(grid.at({x, 0}), 30) << x;
  EXPECT_EQ(grid.at({10, 0}), 90);
  EXPECT_EQ(grid.cell_at({1.05, 0.05}), (Cell{10, 0}));
}

TEST(GridBuilder, KnownProbabilitiesAfterSomeScans) {
  // Recipe: odds multiply. Two hits: 81/82; three misses: (3/7)^3 = 0.0787 -> p = 0.0730.
  GridBuilder builder = builder_of({.resolution_m = 0.1});
  const Scan scan = scan_of({kInfinity, 1.0F, kInfinity, kInfinity});
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(builder.add(scan, {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(builder, 1.05, 0.05), 99);
  ASSERT_TRUE(builder.add(scan, {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(builder, 0.55, 0.05), 7);
}

TEST(GridBuilder, AsManyHitsAsMissesOfEqualWeightReturnToTheMiddle) {
  for (const int k : {1, 2, 5}) {
    GridBuilder builder = builder_of({.resolution_m = 0.1, .p_occupied = 0.7, .p_free = 0.3});
    for (int i = 0; i < k; ++i)
      ASSERT_TRUE(builder.add(scan_of({kInfinity, 1.0F, kInfinity, kInfinity}), {0.05, 0.05, 0.0}));
    EXPECT_GT(percent_at(builder, 1.05, 0.05), 50);
    for (int i = 0; i < k; ++i)
      ASSERT_TRUE(builder.add(scan_of({kInfinity, 2.0F, kInfinity, kInfinity}), {0.05, 0.05, 0.0}));
    EXPECT_EQ(percent_at(builder, 1.05, 0.05), 50);
  }
}

TEST(GridBuilder, TheOrderOfTheScansDoesNotMatter) {
  Rng rng(1);
  std::vector<std::pair<Scan, Pose2>> taken;
  for (int i = 0; i < 30; ++i) {
    std::vector<float> ranges;
    for (int beam = 0; beam < 90; ++beam) ranges.push_back(static_cast<float>(rng.uniform(0.5, 8.0)));
    taken.emplace_back(scan_of(ranges),
                       Pose2{rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)});
  }
  const GridBuilderConfig unlimited{.min_log_odds = -31.0, .max_log_odds = 31.0};
  GridBuilder forward = builder_of(unlimited);
  for (const auto& [scan, pose] : taken) ASSERT_TRUE(forward.add(scan, pose));
  std::reverse(taken.begin(), taken.end());
  GridBuilder backward = builder_of(unlimited);
  for (const auto& [scan, pose] : taken) ASSERT_TRUE(backward.add(scan, pose));
  EXPECT_EQ(forward.grid(), backward.grid());
}

TEST(GridBuilder, ACellIsUpdatedOnceAScanAndEndsWin) {
  // 3600 beams a tenth of a degree apart: every cell near the laser lies under hundreds of them.
  std::vector<float> ranges(3600, 2.0F);
  for (std::size_t i = 0; i < ranges.size(); i += 2)
    ranges[i] = 3.0F;  // every other beam passes the near wall
  GridBuilder builder = builder_of({.resolution_m = 0.1});
  ASSERT_TRUE(builder.add(scan_of(ranges), {0.05, 0.05, 0.0}));
  const OccupancyGrid grid = builder.grid();
  for (const std::int8_t percent : grid.occupancy_percent)
    EXPECT_TRUE(percent == OccupancyGrid::kUnknown || percent == 30 || percent == 90) << int{percent};
  EXPECT_EQ(percent_at(builder, 0.05, 0.05), 30);
  EXPECT_EQ(percent_at(builder, 2.05, 0.05), 90);
  EXPECT_EQ(percent_at(builder, 3.05, 0.05), 90);
}

TEST(GridBuilder, LogOddsStayWithinTheirLimits) {
  GridBuilder builder = builder_of({.resolution_m = 0.1, .min_log_odds = -2.0, .max_log_odds = 3.5});
  for (int i = 0; i < 50; ++i)
    ASSERT_TRUE(builder.add(scan_of({kInfinity, 1.0F, kInfinity, kInfinity}), {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(builder, 1.05, 0.05), std::lround(100.0 / (1.0 + std::exp(-3.5))));
  EXPECT_EQ(percent_at(builder, 0.55, 0.05), std::lround(100.0 / (1.0 + std::exp(2.0))));
}

// The beams are at most 70 mm apart on the walls: each cell that a wall crosses is hit.
TEST(GridBuilder, DrawsTheWallsOfARoomWhereverItStandsAndHoweverTheLaserTurns) {
  const Scan scan = square_room(2.0F);
  for (const Pose2& pose :
       {Pose2{0.0, 0.0, 0.0}, Pose2{-700.0, 1300.0, kPi / 2.0}, Pose2{10.02, -20.01, -kPi / 2.0}}) {
    GridBuilder builder = builder_of({.resolution_m = 0.1});
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(builder.add(scan, pose));
    const OccupancyGrid grid = builder.grid();
    const auto cell_at = [&](const Eigen::Vector2d& p) { return grid.cell_at(pose.translation() + p); };
    for (int i = -18; i < 18; ++i) {
      const double side_m = 0.1 * i + 0.05;
      for (const Eigen::Vector2d& outward :
           {Eigen::Vector2d{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
        const Eigen::Vector2d wall = 2.0 * outward + side_m * Eigen::Vector2d(outward.y(), outward.x());
        // Where the wall is the border of two cells, rounding says which one it is in.
        EXPECT_TRUE(grid.is_occupied(cell_at(wall + 1e-5 * outward)) ||
                    grid.is_occupied(cell_at(wall - 1e-5 * outward)))
            << wall.transpose();
        EXPECT_TRUE(grid.is_free(cell_at(0.7 * wall)));
        EXPECT_FALSE(grid.is_occupied(cell_at(1.2 * wall)));
      }
    }
  }
}

TEST(GridBuilder, GrowingKeepsWhatWasKnown) {
  GridBuilder growing = builder_of({.resolution_m = 0.1});
  GridBuilder roomy = builder_of({.resolution_m = 0.1});
  const Scan far = square_room(90.0F);
  const Scan near = square_room(2.0F);
  ASSERT_TRUE(roomy.add(far, {}));
  for (int i = 0; i < 5; ++i) {
    const Pose2 pose{15.0 * i - 30.0, 40.0 - 20.0 * i, 0.3 * i};
    ASSERT_TRUE(growing.add(near, pose));
    ASSERT_TRUE(roomy.add(near, pose));
  }
  ASSERT_TRUE(growing.add(far, {}));
  EXPECT_EQ(growing.grid(), roomy.grid());
}

TEST(GridBuilder, HitsBeyondMaxRangeFreeTheWayOnly) {
  GridBuilder builder = builder_of({.resolution_m = 0.1, .max_range_m = 5.0});
  ASSERT_TRUE(builder.add(scan_of({kInfinity, 9.0F, kInfinity, kInfinity}), {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(builder, 4.95, 0.05), 30);
  EXPECT_EQ(percent_at(builder, 5.25, 0.05), OccupancyGrid::kUnknown);
  EXPECT_EQ(percent_at(builder, 9.05, 0.05), OccupancyGrid::kUnknown);
}

TEST(GridBuilder, BeamsWithoutReturnSpeakOnlyWhenAsked) {
  const Scan scan = scan_of({kInfinity, 1.0F, kInfinity, 0.0F});
  GridBuilder silent = builder_of({.resolution_m = 0.1});
  ASSERT_TRUE(silent.add(scan, {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(silent, 0.05, 0.55), OccupancyGrid::kUnknown);
  GridBuilder asked = builder_of({.resolution_m = 0.1, .no_return_free_m = 2.0});
  ASSERT_TRUE(asked.add(scan, {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(asked, 0.05, 1.95), 30);
  EXPECT_EQ(percent_at(asked, 0.05, 2.25), OccupancyGrid::kUnknown);
  EXPECT_EQ(percent_at(asked, -0.55, 0.05), OccupancyGrid::kUnknown) << "an invalid beam says nothing";
}

TEST(GridBuilder, MarksOfMoreScansThanTheyCountStillUpdateOnce) {
  // 40000 scans wear out the 16-bit marks; alternating ends keep the cell between the limits.
  GridBuilder builder = builder_of({.resolution_m = 0.1, .p_occupied = 0.7, .p_free = 0.3});
  const Scan hit = scan_of({1.0F, 1.0F, 1.0F, 1.0F});
  const Scan miss = scan_of({2.0F, 2.0F, 2.0F, 2.0F});
  for (int i = 0; i < 40000; ++i) ASSERT_TRUE(builder.add(i % 2 == 0 ? hit : miss, {0.05, 0.05, 0.0}));
  EXPECT_EQ(percent_at(builder, 1.05, 0.05), 50);
}

TEST(GridBuilder, RefusesWhatWouldNotFitAndChangesNothing) {
  GridBuilder builder = builder_of({.resolution_m = 0.01});
  ASSERT_TRUE(builder.add(square_room(1.0F), {}));
  const OccupancyGrid before = builder.grid();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Pose2& pose :
       {Pose2{5000.0, 5000.0, 0.0}, Pose2{1e9, 0.0, 0.0}, Pose2{nan, 0.0, 0.0}, Pose2{0.0, 0.0, nan}}) {
    const auto added = builder.add(square_room(1.0F), pose);
    ASSERT_FALSE(added);
    EXPECT_FALSE(added.error().remedy.empty());
  }
  EXPECT_EQ(builder.grid(), before);
}

TEST(GridBuilder, IsEmptyBeforeTheFirstHit) {
  GridBuilder builder = builder_of({});
  EXPECT_EQ(builder.grid().occupancy_percent.size(), 0U);
  ASSERT_TRUE(builder.add(scan_of({kInfinity, 0.0F, kInfinity}), {}));
  EXPECT_EQ(builder.grid().width_cells, 0);
}

TEST(GridBuilder, RefusesConfigsThatMeanNothing) {
  const auto refused_field = [](const GridBuilderConfig& config) {
    const auto made = GridBuilder::make(config);
    return made ? std::string() : made.error().where;
  };
  EXPECT_EQ(refused_field({.resolution_m = 0.0}), "resolution_m");
  EXPECT_EQ(refused_field({.p_occupied = 0.5}), "p_occupied");
  EXPECT_EQ(refused_field({.p_free = 0.6}), "p_free");
  EXPECT_EQ(refused_field({.max_range_m = kInfinity}), "max_range_m");
  EXPECT_EQ(refused_field({}), "");
}

}  // namespace
}  // namespace beaconless
