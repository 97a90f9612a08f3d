// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/map_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/rasterize.hpp"
#include "beaconless/match/views_in_sight.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

RayCaster walls_of(const FloorPlan& plan) { return RayCaster(plan.segments()); }

double nearest_wall_m(const RayCaster& walls, const Eigen::Vector2d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment2& wall : walls.segments()) least = std::min(least, wall.distance_m(place));
  return least;
}

TEST(MapViews, StandInTheRoomWithSpaceAround) {
  const RayCaster walls = walls_of(test::niche_room());
  const auto views = choose_map_views(walls, nullptr);
  EXPECT_GT(views.size(), 60U);
  bool in_niche = false;
  for (const Pose2& view : views) {
    EXPECT_GT(view.x_m, 0.0);
    EXPECT_LT(view.x_m, 7.5);
    EXPECT_GT(view.y_m, 0.0);
    EXPECT_LT(view.y_m, 5.0);
    // Rays 5 degrees apart judge it, so that the foot of the perpendicular may lie between two.
    EXPECT_GT(nearest_wall_m(walls, view.translation()), 0.3 * std::cos(radians(2.5)) - 1e-9);
    in_niche |= view.x_m > 6.3;
  }
  EXPECT_TRUE(in_niche);
  EXPECT_EQ(choose_map_views(walls, nullptr), views);  // the same bits twice
}

TEST(MapViews, LookAllWays) {
  const auto views = choose_map_views(walls_of(test::rectangle(20, 10)), nullptr);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Pose2& view : views) sum += Eigen::Vector2d(std::cos(view.theta_rad), std::sin(view.theta_rad));
  EXPECT_LT(sum.norm() / static_cast<double>(views.size()), 0.2);
}

TEST(MapViews, InASmallRoomStandCloser) {
  EXPECT_GE(choose_map_views(walls_of(test::rectangle(2.0, 1.6)), nullptr).size(), 60U);
  EXPECT_TRUE(choose_map_views(walls_of(test::rectangle(0.5, 0.5)), nullptr).empty());
  EXPECT_FALSE(choose_map_views(walls_of(test::rectangle(0.5, 0.5)), nullptr, {.clearance_m = 0.1}).empty());
}

TEST(MapViews, InALargeOneThereAreNoMoreThanAsked) {
  for (const auto& plan : {test::rectangle(500, 300), test::rectangle(1e5, 3), test::rectangle(1e7, 1e7)})
    EXPECT_LE(choose_map_views(walls_of(plan), nullptr, {.most = 400}).size(), 900U);
}

TEST(MapViews, OutOfTheHouseThereAreNone) {
  // An L: the missing quarter has walls on two sides only.
  const FloorPlan plan{{{{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}, {0, 0}}}};
  for (const Pose2& view : choose_map_views(walls_of(plan), nullptr))
    EXPECT_FALSE(view.x_m > 4.0 && view.y_m > 4.0);
}

TEST(MapViews, AmongLooseWallsStandWhereMostAre) {
  const FloorPlan plan{{{{0, 0}, {4, 0}}, {{0, 3}, {4, 3}}}};
  const auto views = choose_map_views(walls_of(plan), nullptr);
  EXPECT_FALSE(views.empty());
}

TEST(MapViews, OfAGridStandInFreeCells) {
  const FloorPlan plan = test::rectangle(6, 4);
  OccupancyGrid grid = rasterize(plan).value();
  for (int y = 0; y < grid.height_cells; ++y)
    for (int x = 0; x < grid.width_cells; ++x)
      if (grid.center({x, y}).x() < 3.0 && !grid.is_occupied({x, y}))
        grid.occupancy_percent[grid.index({x, y})] = OccupancyGrid::kUnknown;
  const auto views = choose_map_views(walls_of(plan), &grid);
  EXPECT_FALSE(views.empty());
  for (const Pose2& view : views) EXPECT_TRUE(grid.is_free(grid.cell_at(view.translation())));
  std::fill(grid.occupancy_percent.begin(), grid.occupancy_percent.end(), OccupancyGrid::kUnknown);
  EXPECT_TRUE(choose_map_views(walls_of(plan), &grid).empty());
}

TEST(MapViews, OfNothingAreNone) {
  EXPECT_TRUE(choose_map_views(RayCaster({}), nullptr).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(choose_map_views(RayCaster({{{nan, 0}, {1, 1}}, {{1e300, 0}, {0, 0}}}), nullptr).empty());
}

TEST(MapViews, ASweepIsWhatRaysMeet) {
  const RayCaster walls = walls_of(test::niche_room());
  const Pose2 pose{2.2, 1.1, 2.5};
  const Scan scan = look_at_map(walls, pose, {.range_m = 4.0, .beam_deg = 0.5});
  ASSERT_EQ(scan.size(), 720U);
  EXPECT_TRUE(scan.is_full_circle());
  EXPECT_LT(scan.hit_count(), 720U);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double bearing = pose.theta_rad + scan.angle_rad(i);
    const auto hit = walls.cast(pose.translation(), {std::cos(bearing), std::sin(bearing)}, 4.0);
    ASSERT_EQ(scan.is_hit(i), hit.has_value());
    if (hit) {
      EXPECT_NEAR(static_cast<double>(scan.ranges_m()[i]), hit->range_m, 1e-6);
    }
  }
}

TEST(ViewsInSight, CountsThoseThatNoWallHides) {
  const RayCaster walls({{{0, -1}, {0, 1}}});
  const std::vector<Pose2> views{{-2, 0, 0}, {2, 0, 0}, {3, 0, 0}, {-2, 5, 0}};
  const ViewsInSight sight(views, walls);
  EXPECT_EQ(sight.that_see({1, 0}, 10.0), 3);  // the first is behind the wall, the last looks past its end
  EXPECT_EQ(sight.that_see({1, 0}, 1.5), 1);   // one is that near
  EXPECT_EQ(sight.that_see({0, 0}, 10.0), 4);  // a wall does not hide what is on it
  EXPECT_EQ(sight.that_see({2, 0}, 0.5), 1);   // from where it stands
  EXPECT_EQ(ViewsInSight({}, walls).that_see({1, 0}, 10.0), 0);
}

}  // namespace
}  // namespace beaconless
