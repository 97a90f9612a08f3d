// SPDX-License-Identifier: Apache-2.0
// Where scans and map disagree: what stands there that is not drawn, and what is drawn that does not stand
// there.
#include "beaconless/report/contradictions.hpp"

#include <gtest/gtest.h>

#include "beaconless/map/rasterize.hpp"
#include "beaconless/map/ray_caster.hpp"

namespace beaconless::report {
namespace {

FloorPlan room(double right_m) { return {{{{0, 0}, {right_m, 0}, {right_m, 4}, {0, 4}, {0, 0}}}}; }

/// What a laser sees of walls.
PlacedScan seen(const FloorPlan& walls, const Pose2& map_from_laser) {
  const RayCaster rays(walls.segments());
  RawScan raw;
  raw.angle_min_rad = -3.0F;
  raw.angle_increment_rad = 0.02F;
  raw.range_min_m = 0.05F;
  raw.range_max_m = 30.0F;
  for (int i = 0; i < 300; ++i) {
    const double bearing = raw.angle_min_rad + i * static_cast<double>(raw.angle_increment_rad);
    const double angle = map_from_laser.theta_rad + bearing;
    const auto hit = rays.cast(map_from_laser.translation(), {std::cos(angle), std::sin(angle)}, 30.0);
    raw.ranges_m.push_back(hit ? static_cast<float>(hit->range_m) : 31.0F);
  }
  return {Scan::make(raw).value(), map_from_laser};
}

constexpr Pose2 kStands{2.0, 1.5, 0.7};

TEST(Contradictions, AMapThatIsRightHasNone) {
  const FloorPlan plan = room(6.0);
  const std::vector scans{seen(plan, kStands), seen(plan, {5.9, 3.9, -2.0})};
  const auto found = find_contradictions(plan, scans);
  EXPECT_EQ(found.beam_count, 600U);
  EXPECT_TRUE(found.new_things.empty());
  EXPECT_TRUE(found.missing_walls.empty());
}

TEST(Contradictions, WhatIsNotDrawnIsNew) {
  FloorPlan with_a_box = room(6.0);
  with_a_box.walls.push_back({{4.0, 1.0}, {4.0, 2.0}, {4.5, 2.0}, {4.5, 1.0}, {4.0, 1.0}});
  const auto found = find_contradictions(room(6.0), std::vector{seen(with_a_box, kStands)});
  EXPECT_TRUE(found.missing_walls.empty());
  ASSERT_GT(found.new_things.size(), 10U);
  for (const Eigen::Vector2d& end : found.new_things) {
    EXPECT_GE(end.x(), 3.9);
    EXPECT_LE(end.x(), 4.6);
  }
}

TEST(Contradictions, AWallThatWasTakenAwayIsMissing) {
  const auto found = find_contradictions(room(5.0), std::vector{seen(room(6.0), kStands)});
  ASSERT_GT(found.missing_walls.size(), 10U);
  for (const Eigen::Vector2d& end : found.missing_walls) EXPECT_GT(end.x(), 5.2);
  EXPECT_TRUE(found.new_things.empty());
}

TEST(Contradictions, GridsAreJudgedAlike) {
  const OccupancyGrid grid = rasterize(room(5.0)).value();
  const auto found = find_contradictions(Map(grid), std::vector{seen(room(6.0), kStands)});
  EXPECT_GT(found.missing_walls.size(), 10U);
}

TEST(Contradictions, AMapWithoutWallsExplainsNothing) {
  EXPECT_EQ(find_contradictions(FloorPlan{}, std::vector{seen(room(6.0), kStands)}).beam_count, 0U);
  EXPECT_EQ(find_contradictions(room(6.0), {}).beam_count, 0U);
}

}  // namespace
}  // namespace beaconless::report
