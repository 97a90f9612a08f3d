// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/trajectory.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

Stamp at_s(double seconds_s) { return Stamp::from_seconds(seconds_s); }

/// A robot on a circle of 1 m at 1 rad/s: a constant twist, so that interpolation is exact.
Pose2 on_circle(double t_s) { return {std::sin(t_s), 1.0 - std::cos(t_s), wrap_angle(t_s)}; }

Trajectory circle() {
  Trajectory trajectory;
  for (int i = 0; i <= 20; ++i) trajectory.add(at_s(0.5 * i), on_circle(0.5 * i));
  return trajectory;
}

TEST(Trajectory, AnswersExactlyAtItsStamps) {
  const Trajectory trajectory = circle();
  for (const StampedPose& pose : trajectory) EXPECT_EQ(trajectory.at(pose.stamp), pose.pose);
}

TEST(Trajectory, FollowsAConstantTwistBetweenStamps) {
  const Trajectory trajectory = circle();
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const double t_s = rng.uniform(0.0, 10.0);
    const auto found = trajectory.at(at_s(t_s));
    ASSERT_TRUE(found);
    // A stamp is rounded to half a nanosecond, at 1 m/s and 1 rad/s.
    EXPECT_LT(distance_m(*found, on_circle(t_s)), 1e-9) << t_s;
    EXPECT_LT(heading_difference_rad(*found, on_circle(t_s)), 1e-9) << t_s;
  }
}

TEST(Trajectory, SaysNothingOutsideItsEnds) {
  const Trajectory trajectory = circle();
  EXPECT_FALSE(trajectory.at(Stamp{-1}));
  EXPECT_TRUE(trajectory.at(Stamp{0}));
  EXPECT_TRUE(trajectory.at(at_s(10.0)));
  EXPECT_FALSE(trajectory.at(Stamp{at_s(10.0).ns + 1}));
  EXPECT_FALSE(Trajectory().at(Stamp{0}));
}

TEST(Trajectory, DoesNotBridgeAGap) {
  const Trajectory trajectory({{at_s(0.0), {}}, {at_s(1.0), {1.0, 0.0, 0.0}}, {at_s(3.0), {3.0, 0.0, 0.0}}});
  EXPECT_TRUE(trajectory.at(at_s(0.5), 1.0)) << "a gap of just the allowed length";
  EXPECT_FALSE(trajectory.at(at_s(2.0), 1.0));
  EXPECT_TRUE(trajectory.at(at_s(3.0), 1.0)) << "a stamp that is there always answers";
  EXPECT_DOUBLE_EQ(trajectory.at(at_s(2.0), 2.0)->x_m, 2.0);
}

TEST(Trajectory, SortsByTimeAndKeepsTheOrderOfEqualStamps) {
  Rng rng(2);
  std::vector<StampedPose> poses;
  for (int i = 0; i < 200; ++i)
    poses.push_back({Stamp{static_cast<std::int64_t>(rng.uniform(0.0, 20.0))}, {1.0 * i, 0.0, 0.0}});
  const Trajectory at_once(poses);
  Trajectory one_by_one;
  for (const StampedPose& pose : poses) one_by_one.add(pose.stamp, pose.pose);
  EXPECT_EQ(at_once, one_by_one);
  ASSERT_EQ(at_once.size(), 200U);
  for (std::size_t i = 1; i < at_once.size(); ++i) {
    EXPECT_LE(at_once[i - 1].stamp, at_once[i].stamp);
    if (at_once[i - 1].stamp == at_once[i].stamp) {
      EXPECT_LT(at_once[i - 1].pose.x_m, at_once[i].pose.x_m);
    }
  }
}

TEST(Trajectory, TheFirstOfEqualStampsAnswers) {
  const Trajectory trajectory(
      {{Stamp{5}, {1.0, 0.0, 0.0}}, {Stamp{5}, {2.0, 0.0, 0.0}}, {Stamp{9}, {4.0, 0.0, 0.0}}});
  EXPECT_EQ(trajectory.at(Stamp{5})->x_m, 1.0);
  EXPECT_NEAR(trajectory.at(Stamp{7})->x_m, 3.0, 1e-12) << "between the last of them and the next";
}

TEST(Trajectory, LengthIsTheSumOfTheSteps) {
  EXPECT_EQ(Trajectory().length_m(), 0.0);
  // 20 chords of 0.5 rad on a circle of 1 m.
  EXPECT_NEAR(circle().length_m(), 20.0 * 2.0 * std::sin(0.25), 1e-12);
}

TEST(Trajectory, SurvivesStampsAtTheEndsOfTime) {
  const Stamp first{std::numeric_limits<std::int64_t>::min()};
  const Stamp last{std::numeric_limits<std::int64_t>::max()};
  const Trajectory trajectory({{first, {}}, {last, {1.0, 0.0, 0.0}}});
  EXPECT_FALSE(trajectory.at(Stamp{0}, 1e9));
  EXPECT_NEAR(trajectory.at(Stamp{0}, 1e11)->x_m, 0.5, 1e-9);
}

}  // namespace
}  // namespace beaconless
