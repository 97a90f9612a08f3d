// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/occupancy_level.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

OccupancyLevel level_with(Cell low, Cell high, double resolution_m = 0.05, const Pose2& map_from_grid = {}) {
  OccupancyLevel level(resolution_m, map_from_grid);
  level.cover(low, high).value();
  return level;
}

/// Any values in a 20 x 15 grid.
OccupancyLevel random_level(Rng& rng, double resolution_m = 0.05, const Pose2& map_from_grid = {}) {
  OccupancyLevel level = level_with({0, 0}, {19, 14}, resolution_m, map_from_grid);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) level.set({x, y}, rng.uniform());
  return level;
}

TEST(OccupancyLevel, KeepsValuesToHalfAStep) {
  OccupancyLevel level = level_with({-2, -3}, {4, 5});
  EXPECT_FALSE(level.is_known({0, 0}));
  EXPECT_EQ(level.value({0, 0}), 0.0);
  for (const double value : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
    level.set({-2, 5}, value);
    EXPECT_TRUE(level.is_known({-2, 5}));
    EXPECT_NEAR(level.value({-2, 5}), value, 0.5 / 254.0 + 1e-12);
  }
  EXPECT_EQ(level.value({-2, 5}), 1.0);
  level.forget({-2, 5});
  EXPECT_FALSE(level.is_known({-2, 5}));
  level.set({0, 0}, 7.0);
  EXPECT_EQ(level.value({0, 0}), 1.0);
  for (const double value : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    level.set({0, 0}, value);
    EXPECT_EQ(level.value({0, 0}), 0.0);
  }
  level.set({100, 0}, 1.0);  // has no room
  EXPECT_FALSE(level.is_known({100, 0}));
}

TEST(OccupancyLevel, StencilsHoldTheFourValuesThatCellsHold) {
  Rng rng(2);
  OccupancyLevel level = level_with({-3, 4}, {9, 12});
  for (int i = 0; i < 200; ++i) {
    const Cell cell{static_cast<int>(rng.uniform(-3.0, 10.0)), static_cast<int>(rng.uniform(4.0, 13.0))};
    if (rng.uniform() < 0.2)
      level.forget(cell);
    else
      level.set(cell, rng.uniform());
  }
  const auto byte = [&](Cell cell) -> std::uint32_t {
    return level.is_known(cell) ? static_cast<std::uint32_t>(std::lround(254.0 * level.value(cell))) : 255U;
  };
  ASSERT_EQ(level.stencils().size(), static_cast<std::size_t>(level.stride()) * level.rows());
  std::size_t i = 0;
  for (int y = 4 - 2; y <= 12 + 1; ++y)
    for (int x = -3 - 2; x <= 9 + 1; ++x, ++i)
      ASSERT_EQ(level.stencils()[i], byte({x, y}) | byte({x + 1, y}) << 8U | byte({x, y + 1}) << 16U |
                                         byte({x + 1, y + 1}) << 24U);
}

TEST(OccupancyLevel, GrowingKeepsWhatIsKnown) {
  Rng rng(3);
  OccupancyLevel level(0.1, {1.0, 2.0, 0.3});
  std::map<std::pair<int, int>, double> twin;
  Cell low{0, 0};
  Cell high{0, 0};
  for (int i = 0; i < 60; ++i) {
    const Cell cell{static_cast<int>(rng.normal(40.0)), static_cast<int>(rng.normal(40.0))};
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    ASSERT_TRUE(level.cover(cell, cell).ok());
    const double value = std::floor(rng.uniform(0.0, 255.0)) / 254.0;
    level.set(cell, value);
    twin[{cell.x, cell.y}] = value;
    for (int y = low.y - 2; y <= high.y + 2; ++y)
      for (int x = low.x - 2; x <= high.x + 2; ++x) {
        const auto known = twin.find({x, y});
        ASSERT_EQ(level.is_known({x, y}), known != twin.end());
        ASSERT_NEAR(level.value({x, y}), known == twin.end() ? 0.0 : known->second, 1e-12);
      }
  }
  EXPECT_EQ(level.map_from_grid(), (Pose2{1.0, 2.0, 0.3}));
}

TEST(OccupancyLevel, RefusesToGrowBeyondItsLimitAndStaysAsItWas) {
  OccupancyLevel level = level_with({0, 0}, {3, 3});
  level.set({1, 2}, 1.0);
  const auto grown = level.cover({-2'000'000'000, 0}, {2'000'000'000, 100});
  ASSERT_FALSE(grown.ok());
  EXPECT_FALSE(grown.error().remedy.empty());
  EXPECT_EQ(level.value({1, 2}), 1.0);
  EXPECT_EQ(level.high(), (Cell{3, 3}));
}

TEST(OccupancyLevel, ABlankLevelIsZeroEverywhere) {
  const OccupancyLevel level(0.05, {});
  EXPECT_EQ(level.sample({0.0, 0.0}).value, 0.0);
  EXPECT_FALSE(level.is_near_obstacle({0, 0}));
  EXPECT_EQ(level.stencils().size(), 9U);
}

TEST(OccupancyLevel, TheExampleThatTellsTheBlendsApart) {
  // Values in whole steps, so that they are kept exactly: 0.1, 0.9, 0.3, 0.2 times 250 / 254.
  OccupancyLevel level = level_with({0, 0}, {1, 1}, 1.0);
  const double scale = 250.0 / 254.0;
  level.set({0, 0}, 0.1 * scale);
  level.set({1, 0}, 0.9 * scale);
  level.set({0, 1}, 0.3 * scale);
  level.set({1, 1}, 0.2 * scale);
  const auto sample = level.sample({0.5 + 0.7, 0.5 + 0.2});
  EXPECT_NEAR(sample.slope_per_m.x() / scale, 0.62, 1e-9);
  EXPECT_NEAR(sample.slope_per_m.y() / scale, -0.43, 1e-9);
}

TEST(OccupancyLevel, AnInclinedPlaneIsExact) {
  OccupancyLevel level = level_with({0, 0}, {19, 14}, 0.1);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) level.set({x, y}, (3 * x + 5 * y) / 254.0);
  Rng rng(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d point(rng.uniform(0.05, 1.95), rng.uniform(0.05, 1.45));
    const auto sample = level.sample(point);
    EXPECT_NEAR(sample.value, (3.0 * (point.x() / 0.1 - 0.5) + 5.0 * (point.y() / 0.1 - 0.5)) / 254.0, 1e-12);
    EXPECT_NEAR(sample.slope_per_m.x(), 30.0 / 254.0, 1e-12);
    EXPECT_NEAR(sample.slope_per_m.y(), 50.0 / 254.0, 1e-12);
  }
}

TEST(OccupancyLevel, TheSlopeIsThatOfTheValues) {
  Rng rng(5);
  const Pose2 map_from_grid{3.0, -2.0, 0.7};
  const OccupancyLevel level = random_level(rng, 0.05, map_from_grid);
  constexpr double kStep_m = 1e-7;
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d cells(rng.uniform(-1.0, 21.0), rng.uniform(-1.0, 16.0));
    const Eigen::Vector2d from_edge = (cells.array() - 0.5) - (cells.array() - 0.5).floor();
    if (from_edge.minCoeff() < 1e-4 || from_edge.maxCoeff() > 1.0 - 1e-4) continue;  // kinks have no slope
    const Eigen::Vector2d point = map_from_grid * (0.05 * cells);
    const Eigen::Vector2d slope = level.sample(point).slope_per_m;
    for (const int axis : {0, 1}) {
      const Eigen::Vector2d step = kStep_m * Eigen::Vector2d::Unit(axis);
      const double central =
          (level.sample(point + step).value - level.sample(point - step).value) / (2.0 * kStep_m);
      ASSERT_NEAR(slope[axis], central, 1e-6);  // rounding: 1e-16 / 1e-7, times values of 20 a metre
    }
    ++compared;
  }
  EXPECT_GT(compared, 450);
}

TEST(OccupancyLevel, TheBorderOfTheKnownHasNoSlope) {
  OccupancyLevel level = level_with({0, 0}, {9, 9});
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 5; ++x) level.set({x, y}, OccupancyLevel::value_of(0.2));
  for (double x = 0.0; x < 0.5; x += 0.01) {
    EXPECT_EQ(level.sample({x, 0.25}).value, 0.0);
    EXPECT_EQ(level.sample({x, 0.25}).slope_per_m.norm(), 0.0);
  }
  // A wall before the unknown is as steep behind as in front.
  level.set({4, 5}, 1.0);
  const double y = 5.5 * 0.05;
  EXPECT_NEAR(level.sample({4.2 * 0.05, y}).value, level.sample({4.8 * 0.05, y}).value, 1e-12);
}

TEST(OccupancyLevel, ValuesOfProbabilities) {
  EXPECT_EQ(OccupancyLevel::value_of(0.0), 0.0);
  EXPECT_EQ(OccupancyLevel::value_of(0.49), 0.0);
  EXPECT_EQ(OccupancyLevel::value_of(0.5), 0.0);
  EXPECT_NEAR(OccupancyLevel::value_of(0.9), 0.8, 1e-12);
  EXPECT_EQ(OccupancyLevel::value_of(1.0), 1.0);
}

TEST(OccupancyLevel, NearAnObstacleIsWhereTheInterpolationIsAboveZero) {
  Rng rng(6);
  OccupancyLevel level = level_with({0, 0}, {9, 9}, 1.0);
  for (int i = 0; i < 12; ++i)
    level.set({static_cast<int>(rng.uniform(0.0, 10.0)), static_cast<int>(rng.uniform(0.0, 10.0))}, i % 2);
  for (int y = -3; y < 13; ++y)
    for (int x = -3; x < 13; ++x)
      EXPECT_EQ(level.is_near_obstacle({x, y}), level.sample({x + 1.0, y + 1.0}).value > 0.0);
}

}  // namespace
}  // namespace beaconless
