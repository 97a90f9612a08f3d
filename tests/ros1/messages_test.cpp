// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/scan/scan.hpp"

#include "bridges/ros1/grid_of_message.hpp"
#include "bridges/ros1/mounted_laser.hpp"
#include "bridges/ros1/stamp_watch.hpp"
#include "bridges/ros1/told.hpp"

namespace beaconless::ros1 {
namespace {

ScanMessage three_beams() {
  return {.stamp_ns = 5,
          .frame_id = "laser",
          .angle_min_rad = -0.5F,
          .angle_increment_rad = 0.5F,
          .range_min_m = 0.1F,
          .range_max_m = 10.0F,
          .ranges_m = {1.0F, 2.0F, 3.0F}};
}

/// The place of a point of the laser in the base frame, by the whole rotation in space.
Eigen::Vector2d in_base(const Transform& t, const Eigen::Vector2d& point) {
  const Eigen::Quaterniond turn(t.qw, t.qx, t.qy, t.qz);
  const Eigen::Vector3d at = turn * Eigen::Vector3d(point.x(), point.y(), 0.0);
  return {at.x() + t.x_m, at.y() + t.y_m};
}

TEST(MountedLaser, UprightOrUpsideDownPutsPointsWhereSpaceDoes) {
  const double c = std::cos(0.35), s = std::sin(0.35);
  for (const Transform& mount :
       {Transform{0.2, -0.1, 0.4, 0.0, 0.0, s, c}, Transform{0.2, -0.1, 0.4, c, s, 0.0, 0.0}}) {
    const auto laser = mounted_laser(mount);
    ASSERT_TRUE(laser) << laser.error();
    EXPECT_NEAR(laser->tilt_rad, 0.0, 1e-7);
    const auto as_is = Scan::make(upright(three_beams(), MountedLaser{}));
    const auto turned = Scan::make(upright(three_beams(), *laser));
    ASSERT_TRUE(as_is && turned);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = laser->is_upside_down ? 2 - i : i;
      EXPECT_LT((laser->base_from_laser * turned->point(k) - in_base(mount, as_is->point(i))).norm(), 1e-6);
    }
  }
}

TEST(MountedLaser, IsRefusedOnItsEdgeOrWithoutARotation) {
  EXPECT_FALSE(mounted_laser({0, 0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(mounted_laser({0, 0, 0, std::sqrt(0.5), 0, 0, std::sqrt(0.5)}));
  EXPECT_FALSE(mounted_laser({std::nan(""), 0, 0, 0, 0, 0, 1}));
}

TEST(GridOfMessage, KeepsCellsAndOriginAndKnowsNoOthers) {
  GridMessage message{"map", 0.5, 2, 1, {1.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0}, {100, 120}};
  const auto grid = grid_of_message(message);
  ASSERT_TRUE(grid) << grid.error();
  EXPECT_EQ(grid->occupancy_percent, (std::vector<std::int8_t>{100, -1}));
  EXPECT_NEAR(std::abs(grid->map_from_grid.theta_rad), kPi, 1e-12);
}

TEST(GridOfMessage, RefusesWhatIsNone) {
  const GridMessage good{"map", 0.5, 2, 1, {}, {0, 0}};
  ASSERT_TRUE(grid_of_message(good));
  GridMessage bad = good;
  bad.width_cells = 3;
  EXPECT_FALSE(grid_of_message(bad));
  bad = good;
  bad.width_cells = bad.height_cells = 0xffffffffU;
  EXPECT_FALSE(grid_of_message(bad));
  bad = good;
  bad.resolution_m = std::nan("");
  EXPECT_FALSE(grid_of_message(bad));
  bad = good;
  bad.origin.qw = 0.0;
  EXPECT_FALSE(grid_of_message(bad));
}

TEST(StampWatch, TellsOvertakenFromAClockThatWasSet) {
  StampWatch watch;
  EXPECT_EQ(watch.see(Stamp{10'000'000'000}), StampOrder::follows);
  EXPECT_EQ(watch.see(Stamp{10'000'000'000}), StampOrder::repeated);
  EXPECT_EQ(watch.see(Stamp{9'900'000'000}), StampOrder::earlier);
  EXPECT_EQ(watch.see(Stamp{10'100'000'000}), StampOrder::follows);
  EXPECT_EQ(watch.see(Stamp{2'000'000'000}), StampOrder::jumped_back);
  EXPECT_EQ(watch.see(Stamp{2'100'000'000}), StampOrder::follows);
}

TEST(PoseMessage, HasTheCovarianceOfXYAndYawInItsPlaces) {
  PoseEstimate estimate;
  estimate.covariance << 1, 2, 3, 2, 4, 5, 3, 5, 6;
  const PoseMessage pose = pose_message(estimate, "map");
  EXPECT_EQ(pose.covariance[0], 1);
  EXPECT_EQ(pose.covariance[1], 2);
  EXPECT_EQ(pose.covariance[5], 3);
  EXPECT_EQ(pose.covariance[7], 4);
  EXPECT_EQ(pose.covariance[11], 5);
  EXPECT_EQ(pose.covariance[30], 3);
  EXPECT_EQ(pose.covariance[35], 6);
}

TEST(TransformOf, IsUndoneByPoseOf) {
  const Pose2 pose{1.0, -2.0, 2.5};
  const auto back = pose_of(transform_of(pose));
  ASSERT_TRUE(back);
  EXPECT_LT(distance_m(*back, pose) + heading_difference_rad(*back, pose), 1e-12);
}

TEST(BeamsMessage, LieOnTheWallWhileTheRobotTurns) {
  // A wall at x = 2 m, a tenth of a second from beam to beam.
  const double rate = 0.5;  // rad/s
  ScanMessage message = three_beams();
  message.angle_min_rad = -0.2F, message.angle_increment_rad = 0.2F, message.time_increment_s = 0.1F;
  for (std::size_t i = 0; i < 3; ++i) {
    const double bearing = -0.2 + 0.2 * static_cast<double>(i) + rate * 0.1 * static_cast<double>(i);
    message.ranges_m[i] = static_cast<float>(2.0 / std::cos(bearing));
  }
  message.stamp_ns = 1'000'000'000;
  const auto scan = Scan::make(upright(message, MountedLaser{}));
  ASSERT_TRUE(scan);
  PoseEstimate before;
  before.stamp = Stamp{900'000'000}, before.map_from_base.theta_rad = -0.1 * rate;
  PoseEstimate now;
  now.stamp = Stamp{1'000'000'000};
  const auto beams = beams_message(before, now, *scan, Pose2{}, "map");
  ASSERT_EQ(beams.points_m.size(), 3U);
  for (const auto& point : beams.points_m) EXPECT_NEAR(point[0], 2.0, 1e-6);
  EXPECT_GT(std::abs(beams_message({}, now, *scan, Pose2{}, "map").points_m[2][0] - 2.0), 0.01);
}

TEST(DiagnosticMessage, HasTheWorstOnTop) {
  PoseEstimate estimate;
  estimate.status = Status::ok, estimate.reason = "", estimate.quality = 0.9;
  EXPECT_EQ(diagnostic_message(estimate, {}).level, Level::ok);
  estimate.quality = 0.2;
  EXPECT_EQ(diagnostic_message(estimate, {}).level, Level::warn);
  const auto message = diagnostic_message(estimate, {{"tf", {Level::error, "no laser"}}});
  EXPECT_EQ(message.level, Level::error);
  EXPECT_EQ(message.message, "no laser");
}

}  // namespace
}  // namespace beaconless::ros1
