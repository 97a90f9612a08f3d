// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/drive.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace beaconless::sim {
namespace {

const Ellipse kEllipse{.center_x_m = 3.0,
                       .center_y_m = -1.0,
                       .semi_axis_x_m = 3.0,
                       .semi_axis_y_m = 1.5,
                       .heading_deg = 25.0,
                       .start_deg = 40.0,
                       .turns = 1.0,
                       .speed_mps = 0.6};
const Waypoints kWaypoints{
    .points = {{0, 0}, {3, 0}, {3, 2}, {3, 2}, {2.9, 2}}, .speed_mps = 0.8, .rate_degps = 60.0};

/// The twist of the base, per second, from two poses a millisecond apart.
Twist2 twist_per_s(const Drive& drive, double time_s) {
  constexpr double kStep_s = 1e-3;
  const Pose2 before = drive.map_from_base(time_s - 0.5 * kStep_s);
  const Pose2 after = drive.map_from_base(time_s + 0.5 * kStep_s);
  return 1.0 / kStep_s * (before.inverse() * after).log();
}

TEST(Drive, StandingStands) {
  const Drive drive(Standing{1.0, 2.0, 90.0});
  EXPECT_EQ(drive.duration_s(), 0.0);
  for (const double t : {-1.0, 0.0, 5.0, 1e6})
    EXPECT_EQ(drive.map_from_base(t), (Pose2{1.0, 2.0, kPi / 2.0}));
}

TEST(Drive, TurningTurnsInPlaceByTheAngle) {
  const Drive drive(Turning{1.0, 2.0, 10.0, -360.0, 45.0});
  EXPECT_NEAR(drive.duration_s(), 8.0 + Drive::kRamp_s, 1e-12);
  EXPECT_NEAR(heading_difference_rad(drive.map_from_base(0.0), drive.map_from_base(99.0)), 0.0, 1e-12);
  EXPECT_NEAR(twist_per_s(drive, 4.0).theta_rad, radians(-45.0), 1e-9);
  for (double t = 0.0; t < 10.0; t += 0.1) {
    EXPECT_EQ(drive.map_from_base(t).x_m, 1.0);
    EXPECT_EQ(drive.map_from_base(t).y_m, 2.0);
  }
}

TEST(Drive, EllipseStaysOnTheEllipseNoseAlongThePathAtASteadySpeed) {
  for (const double turns : {1.0, -2.0}) {
    Ellipse path = kEllipse;
    path.turns = turns;
    const Drive drive(path);
    const Pose2 ellipse_from_map = Pose2{3.0, -1.0, radians(25.0)}.inverse();
    for (double t = 0.0; t < drive.duration_s() + 2.0; t += 0.037) {
      const Pose2 pose = ellipse_from_map * drive.map_from_base(t);
      EXPECT_NEAR(std::hypot(pose.x_m / 3.0, pose.y_m / 1.5), 1.0, 1e-12);
      if (t <= Drive::kRamp_s || t >= drive.duration_s() - Drive::kRamp_s) continue;
      const Twist2 twist = twist_per_s(drive, t);
      EXPECT_NEAR(twist.x_m, 0.6, 1e-3);  // the table is linear within steps of 1.5 mrad
      EXPECT_NEAR(twist.y_m, 0.0, 1e-4);
      EXPECT_GT(twist.theta_rad * turns, 0.0);
    }
  }
}

TEST(Drive, EllipseReturnsToItsStart) {
  const Drive drive(kEllipse);
  EXPECT_LT(distance_m(drive.map_from_base(0.0), drive.map_from_base(drive.duration_s())), 1e-9);
  EXPECT_LT(heading_difference_rad(drive.map_from_base(0.0), drive.map_from_base(drive.duration_s())), 1e-9);
  EXPECT_GT(distance_m(drive.map_from_base(0.0), drive.map_from_base(0.5 * drive.duration_s())), 4.0);
  // Ramanujan's second approximation of the circumference is good to 1e-5 here.
  const double h = std::pow((3.0 - 1.5) / (3.0 + 1.5), 2.0);
  const double around_m = kPi * 4.5 * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
  EXPECT_NEAR(drive.duration_s(), around_m / 0.6 + Drive::kRamp_s, 1e-3);
}

TEST(Drive, WaypointsAreReachedInOrder) {
  const Drive drive(kWaypoints);
  std::size_t reached = 0;
  for (double t = 0.0; t <= drive.duration_s() + 0.01; t += 0.01)
    if (reached < kWaypoints.points.size() &&
        (drive.map_from_base(t).translation() - kWaypoints.points[reached]).norm() < 1e-3)
      ++reached;
  EXPECT_EQ(reached, kWaypoints.points.size());
  EXPECT_NEAR(drive.map_from_base(0.0).theta_rad, 0.0, 1e-12);
  EXPECT_NEAR(heading_difference_rad(drive.map_from_base(99.0), Pose2{0, 0, kPi}), 0.0, 1e-12);
  EXPECT_EQ(Drive(Waypoints{}).map_from_base(1.0), Pose2{});
}

TEST(Drive, SpeedNeverJumpsAndNeverGoesSideways) {
  for (const Path& path : {Path(kEllipse), Path(kWaypoints), Path(Turning{})}) {
    const Drive drive(path);
    Twist2 last = twist_per_s(drive, -0.1);
    EXPECT_NEAR(last.vector().norm(), 0.0, 1e-9);
    for (double t = -0.1; t < drive.duration_s() + 0.1; t += 0.01) {
      const Twist2 twist = twist_per_s(drive, t);
      // The steepest part of a half cosine of 1 s from 0 to v is pi/2 v per second; 45 deg/s and 60 deg/s
      // turns.
      EXPECT_LT(std::abs(twist.x_m - last.x_m), 0.01 * kPi / 2.0 * 0.8 + 1e-3);
      EXPECT_LT(std::abs(twist.theta_rad - last.theta_rad), 0.01 * kPi / 2.0 * radians(60.0) + 1e-3);
      EXPECT_NEAR(twist.y_m, 0.0, 1e-4);
      last = twist;
    }
    EXPECT_NEAR(last.vector().norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace beaconless::sim
