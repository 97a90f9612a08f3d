// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/hector_slam.hpp"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/slam/drives.hpp"
#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

using test::niche_room;
using test::rounds;
using test::scan_at;
using test::slam_at;
using test::TrueScan;
using testing::HasSubstr;

bool is_finite(const PoseEstimate& estimate) {
  return estimate.map_from_base.is_finite() && estimate.covariance.allFinite() &&
         (estimate.covariance.diagonal().array() >= 0.0).all() && estimate.quality >= 0.0 &&
         estimate.quality <= 1.0;
}

/// Metres from a point to the nearest wall.
double to_walls_m(const FloorPlan& plan, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment2& wall : plan.segments()) nearest = std::min(nearest, wall.distance_m(point));
  return nearest;
}

// Half a cell in x and y is what the cells' middles are off by at worst, and the walls of this room lie along
// them; that of opposite walls does not average out.
TEST(HectorSlam, KeepsItsPathInARoomItHasNeverSeen) {
  const auto drive = rounds(niche_room(), 0.01, 120);
  HectorSlam slam = slam_at(drive.front().map_from_laser);
  for (const TrueScan& at : drive) {
    const PoseEstimate estimate = slam.update(at.scan);
    EXPECT_EQ(estimate.status, Status::ok) << estimate.reason;
    EXPECT_LT(distance_m(estimate.map_from_base, at.map_from_laser), 0.035);
    EXPECT_LT(degrees(heading_difference_rad(estimate.map_from_base, at.map_from_laser)), 0.6);
    EXPECT_TRUE(is_finite(estimate));
  }
  EXPECT_GT(slam.map().scan_count(), 15U);
  EXPECT_LT(slam.map().scan_count(), 121U);
}

TEST(HectorSlam, DrawsTheRoomWithinACellOfItsPlan) {
  const FloorPlan room = niche_room();
  const auto drive = rounds(room, 0.01, 120);
  HectorSlam slam = slam_at(drive.front().map_from_laser);
  for (const TrueScan& at : drive) (void)slam.update(at.scan);
  const OccupancyGrid grid = slam.grid();
  EXPECT_EQ(grid.resolution_m, 0.05);
  // 1. What is drawn stands there: a cell may be beside the one that the wall runs through, or along whose
  // border it runs; its middle is then up to a cell and a half away.
  int drawn = 0;
  for (int y = 0; y < grid.height_cells; ++y) {
    for (int x = 0; x < grid.width_cells; ++x) {
      if (!grid.is_occupied({x, y})) continue;
      ++drawn;
      EXPECT_LT(to_walls_m(room, grid.center({x, y})), 0.0751) << grid.center({x, y}).transpose();
    }
  }
  EXPECT_GT(drawn, 300);
  // 2. What stands is drawn: along every wall but the one end of the pillar that no beam met.
  int missing = 0;
  int asked = 0;
  for (const Segment2& wall : room.segments()) {
    const int steps = static_cast<int>((wall.b - wall.a).norm() / 0.05);
    for (int i = 1; i < steps; ++i, ++asked) {
      const Cell cell = grid.cell_at(wall.a + (wall.b - wall.a) * i / steps);
      bool is_drawn = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) is_drawn = is_drawn || grid.is_occupied({cell.x + dx, cell.y + dy});
      missing += is_drawn ? 0 : 1;
    }
  }
  EXPECT_LT(missing, asked / 50);
  EXPECT_TRUE(grid.is_free(grid.cell_at({3.0, 1.2})));
}

TEST(HectorSlam, TheStartPoseIsTheMapsFrameAndNothingElse) {
  const auto drive = rounds(niche_room(), 0.01, 40);
  HectorSlam origin = slam_at({});
  HectorSlam elsewhere = slam_at({7.0, -3.0, 0.0});
  for (const TrueScan& at : drive) {
    const PoseEstimate a = origin.update(at.scan);
    const PoseEstimate b = elsewhere.update(at.scan);
    EXPECT_NEAR(a.map_from_base.x_m + 7.0, b.map_from_base.x_m, 1e-3);
    EXPECT_NEAR(a.map_from_base.y_m - 3.0, b.map_from_base.y_m, 1e-3);
  }
  EXPECT_EQ(origin.map().scan_count(), elsewhere.map().scan_count());
}

TEST(HectorSlam, ALaserAheadOfTheBase) {
  HectorSlamConfig config;
  config.base_from_laser = {0.7, 0.1, 0.3};
  const auto drive = rounds(niche_room(), 0.005, 60);
  const Pose2 laser_from_base = config.base_from_laser.inverse();
  HectorSlam slam = slam_at(drive.front().map_from_laser * laser_from_base, config);
  for (const TrueScan& at : drive)
    EXPECT_LT(distance_m(slam.update(at.scan).map_from_base, at.map_from_laser * laser_from_base), 0.04);
}

TEST(HectorSlam, TheSameBitsTwice) {
  const auto drive = rounds(niche_room(), 0.01, 60, 25);
  HectorSlam first = slam_at({});
  HectorSlam second = slam_at({});
  for (const TrueScan& at : drive) EXPECT_EQ(first.update(at.scan), second.update(at.scan));
  EXPECT_EQ(first.grid(), second.grid());
}

// At rest, turned, at rest again: a wall at 3 m moves by up to 1.5 m from one scan to the next.
TEST(HectorSlam, ATurnBeyondTheMatchersBasinIsFoundBySearching) {
  const FloorPlan room = niche_room();
  const RayCaster walls(room.segments());
  for (const double turn_deg : {20.0, -28.0}) {
    Rng rng(3);
    std::vector<TrueScan> drive;
    for (int i = 0; i < 16; ++i) {
      const Pose2 pose{3.4, 2.1, 0.4 + radians(turn_deg) * (i / 4)};
      drive.push_back({scan_at(walls, pose, 0.01, rng, Stamp::from_seconds(i / 8.0)), pose});
    }
    for (const SlamSearch when : {SlamSearch::in_doubt, SlamSearch::always, SlamSearch::never}) {
      HectorSlamConfig config;
      config.search_when = when;
      HectorSlam slam = slam_at(drive.front().map_from_laser, config);
      double worst_deg = 0.0;
      for (const TrueScan& at : drive) {
        const PoseEstimate estimate = slam.update(at.scan);
        worst_deg =
            std::max(worst_deg, degrees(heading_difference_rad(estimate.map_from_base, at.map_from_laser)));
      }
      if (when == SlamSearch::never)
        EXPECT_GT(worst_deg, 5.0) << "this turn proves nothing";
      else
        EXPECT_LT(worst_deg, 1.0) << turn_deg;
    }
  }
}

TEST(HectorSlam, ScansOfAnotherPlaceMoveNeitherTheRobotNorTheMap) {
  const auto drive = rounds(niche_room(), 0.01, 60);
  const RayCaster other(test::rectangle(1.7, 23.0).segments());
  HectorSlamConfig config;
  HectorSlam slam = slam_at(drive.front().map_from_laser, config);
  for (int i = 0; i < 40; ++i) (void)slam.update(drive[static_cast<std::size_t>(i)].scan);
  const OccupancyGrid before = slam.grid();
  Rng rng(5);
  for (int i = 0; i < 14; ++i) {
    const PoseEstimate estimate =
        slam.update(scan_at(other, {0.8, 9.0, 0.1}, 0.01, rng, Stamp::from_seconds((40.0 + 0.01 * i) / 8.0)));
    EXPECT_EQ(estimate.status, i + 1 < config.lost_after_scans ? Status::degraded : Status::lost) << i;
    EXPECT_NE(estimate.reason, "");
    EXPECT_LT(distance_m(estimate.map_from_base, drive[40].map_from_laser), 0.3);
    EXPECT_TRUE(is_finite(estimate));
  }
  EXPECT_EQ(slam.grid(), before);
  // Back again, it goes on where it was; a lost robot searches with every fourth scan.
  PoseEstimate estimate;
  for (std::size_t i = 40; i < 46; ++i) estimate = slam.update(drive[i].scan);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.reason;
  EXPECT_LT(distance_m(estimate.map_from_base, drive[45].map_from_laser), 0.04);
}

TEST(HectorSlam, NewGroundIsNoContradiction) {
  // Most of what a scan sees at the end of the hall was not seen from its beginning.
  const RayCaster walls(test::hall().segments());
  Rng rng(7);
  HectorSlam slam = slam_at(test::through_hall(0));
  int ok = 0;
  for (int i = 0; i < 260; ++i) {
    const Pose2 pose = test::through_hall(i);
    const PoseEstimate estimate = slam.update(scan_at(walls, pose, 0.01, rng, Stamp::from_seconds(i / 8.0)));
    ok += estimate.ok() ? 1 : 0;
    EXPECT_LT(distance_m(estimate.map_from_base, pose), 0.15) << i;
  }
  EXPECT_GE(ok, 255);
}

TEST(HectorSlam, InABareCorridorItSaysSo) {
  const RayCaster walls(FloorPlan{{{{-500, 0}, {500, 0}}, {{-500, 2.03}, {500, 2.03}}}}.segments());
  Rng rng(9);
  HectorSlam slam = slam_at({});
  int degraded = 0;
  for (int i = 0; i < 20; ++i) {
    const PoseEstimate estimate =
        slam.update(scan_at(walls, {0.05 * i, 1.0, 0.0}, 0.01, rng, Stamp::from_seconds(i / 8.0)));
    degraded += i > 0 && estimate.status == Status::degraded ? 1 : 0;
    EXPECT_LT(std::abs(estimate.map_from_base.y_m), 0.06);
    EXPECT_TRUE(is_finite(estimate));
  }
  EXPECT_GE(degraded, 17);
}

TEST(HectorSlam, OddEventsGetAnHonestWord) {
  HectorSlam slam = slam_at({1.0, 2.0, 0.5});
  const float inf = std::numeric_limits<float>::infinity();
  const auto scan_of = [](std::vector<float> ranges, double at_s) {
    return Scan::make({.stamp = Stamp::from_seconds(at_s),
                       .angle_min_rad = -1.0F,
                       .angle_increment_rad = 0.01F,
                       .range_max_m = 30.0F,
                       .ranges_m = std::move(ranges)})
        .value();
  };
  // 1. Before the first scan that hits something.
  EXPECT_EQ(slam.update(Odometry{}).status, Status::not_started);
  EXPECT_EQ(slam.update(scan_of(std::vector<float>(200, inf), 0.0)).status, Status::not_started);
  EXPECT_EQ(slam.update(scan_of({2.0F}, 0.1)).status, Status::not_started);
  EXPECT_EQ(slam.update(scan_of({2.0F}, 0.1)).map_from_base, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_TRUE(slam.grid().occupancy_percent.empty());
  // 2. The one that begins the map, and odd ones after it.
  const auto drive = rounds(niche_room(), 0.01, 5);
  EXPECT_EQ(slam.update(drive[0].scan).status, Status::ok);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Event& event : {Event(Odometry{.odom_from_base = {nan, 0.0, 0.0}}),
                             Event(ReferencePose{.map_from_base = {nan, nan, nan}})}) {
    EXPECT_EQ(slam.update(event).status, Status::not_a_scan);
    EXPECT_EQ(slam.update(event).map_from_base, (Pose2{1.0, 2.0, 0.5}));
  }
  for (const Scan& scan :
       {scan_of(std::vector<float>(200, inf), 0.2), scan_of({2.0F}, 0.3),
        scan_of(std::vector<float>(200, 0.0F), 0.4), scan_of(std::vector<float>(200, 0.06F), 0.5),
        scan_of(std::vector<float>(200, 29.9F), -1e9), scan_of(std::vector<float>(200, 1.0F), 9e9)}) {
    const PoseEstimate estimate = slam.update(scan);
    EXPECT_EQ(estimate.status, Status::degraded) << scan.stamp();
    EXPECT_NE(estimate.reason, "");
    EXPECT_TRUE(is_finite(estimate));
    EXPECT_EQ(estimate.stamp, scan.stamp());
  }
}

TEST(HectorSlam, AMapOfAsManyCellsAsItMayHaveGrowsNoMore) {
  HectorSlamConfig config;
  config.map.max_cells = 30'000;  // the hall is 160 x 600 cells
  config.beams.max_range_m = 6.0;
  const RayCaster walls(test::hall().segments());
  Rng rng(11);
  HectorSlam slam = slam_at(test::through_hall(0), config);
  bool was_full = false;
  for (int i = 0; i < 150; ++i) {
    const PoseEstimate estimate =
        slam.update(scan_at(walls, test::through_hall(i), 0.01, rng, Stamp::from_seconds(i / 8.0)));
    EXPECT_TRUE(is_finite(estimate));
    const bool is_full = estimate.reason.find("map.max_cells") != std::string_view::npos;
    EXPECT_TRUE(!is_full || estimate.status == Status::degraded);
    was_full = was_full || is_full;
  }
  EXPECT_TRUE(was_full);
  EXPECT_LE(slam.grid().occupancy_percent.size(), 30'000U);
  config.map.max_cells = 1000;
  slam = slam_at({}, config);
  const PoseEstimate none = slam.update(scan_at(walls, {2.0, 2.0, 1.5}, 0.01, rng, {}));
  EXPECT_EQ(none.status, Status::not_started);
  EXPECT_THAT(std::string(none.reason), HasSubstr("max_cells"));
}

TEST(HectorSlam, OdometryHelpsWhereTheLaserCannotTell) {
  const RayCaster walls(FloorPlan{{{{-500, 0}, {500, 0}}, {{-500, 2.03}, {500, 2.03}}}}.segments());
  for (const SlamGuess guess : {SlamGuess::odometry, SlamGuess::last_pose}) {
    Rng rng(13);
    HectorSlamConfig config;
    config.guess = guess;
    HectorSlam slam = slam_at({}, config);
    PoseEstimate estimate;
    for (int i = 0; i <= 30; ++i) {
      const Stamp stamp = Stamp::from_seconds(i / 8.0);
      // A robot that goes and stops at will; the odometry has a frame of its own.
      const double x_m = 0.06 * i + 0.1 * std::sin(0.9 * i);
      const Pose2 odom_from_base = Pose2{5.0, -3.0, 2.0} * Pose2{x_m, 0.0, 0.0};
      (void)slam.update(Odometry{.stamp = stamp, .odom_from_base = odom_from_base});
      estimate = slam.update(scan_at(walls, {x_m, 1.0, 0.0}, 0.01, rng, stamp));
    }
    const double error_m = std::abs(estimate.map_from_base.x_m - (0.06 * 30 + 0.1 * std::sin(27.0)));
    if (guess == SlamGuess::odometry)
      EXPECT_LT(error_m, 0.1);
    else
      EXPECT_GT(error_m, 0.5) << "the corridor gives its axis away";
  }
}

TEST(HectorSlam, AsksForNoMemoryOnceTheMapHasGrown) {
  const auto drive = rounds(niche_room(), 0.01, 120);
  HectorSlamConfig config;
  config.search_when = SlamSearch::always;
  HectorSlam slam = slam_at(drive.front().map_from_laser, config);
  for (std::size_t i = 0; i < 80; ++i) (void)slam.update(drive[i].scan);
  std::vector<Event> events;
  for (std::size_t i = 80; i < drive.size(); ++i) events.emplace_back(drive[i].scan);
  const std::size_t drawn = slam.map().scan_count();
  const std::size_t before = test::allocations();
  for (const Event& event : events) (void)slam.update(event);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(slam.map().scan_count(), drawn);
}

TEST(HectorSlam, RefusesConfigsThatMeanNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HectorSlamConfig config;
  config.map.p_free = 0.6;
  const auto refused = HectorSlam::make(config);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "map.p_free");
  config = {};
  config.search.step_deg = 0.0;
  EXPECT_FALSE(HectorSlam::make(config));
  for (const Pose2& start : {Pose2{nan, 0.0, 0.0}, Pose2{0.0, 0.0, nan}, Pose2{2e5, 0.0, 0.0}})
    EXPECT_FALSE(HectorSlam::make({}, start));
}

}  // namespace
}  // namespace beaconless
