// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/start_guess.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace beaconless::ros1 {
namespace {

using testing::HasSubstr;

/// As RViz sends it.
PoseMessage by_rviz() {
  PoseMessage pose{0, "map", {1.0, 2.0, 0.0, 0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)}, {}};
  pose.covariance[0] = pose.covariance[7] = 0.25;
  pose.covariance[35] = 0.06853891945200942;
  return pose;
}

TEST(StartGuess, OfRvizIsAPose) {
  const auto guess = start_guess_of(by_rviz(), "map");
  ASSERT_TRUE(guess) << guess.error();
  EXPECT_FALSE(guess->within);
  EXPECT_EQ(guess->map_from_base.x_m, 1.0);
  EXPECT_NEAR(guess->map_from_base.theta_rad, kPi / 2.0, 1e-12);
}

TEST(StartGuess, ThatIsWideIsARegion) {
  PoseMessage pose = by_rviz();
  pose.covariance[7] = 4.0;
  const auto guess = start_guess_of(pose, "map");
  ASSERT_TRUE(guess) << guess.error();
  ASSERT_TRUE(guess->within);
  EXPECT_EQ(guess->within->radius_m, 6.0);
  EXPECT_EQ(guess->within->middle, Eigen::Vector2d(1.0, 2.0));
}

TEST(StartGuess, OfAnyHeadingIsARegion) {
  PoseMessage pose = by_rviz();
  pose.covariance[35] = 10.0;
  const auto guess = start_guess_of(pose, "map");
  ASSERT_TRUE(guess) << guess.error();
  ASSERT_TRUE(guess->within);
  EXPECT_EQ(guess->within->radius_m, 1.5);
}

TEST(StartGuess, ThatIsNoneIsRefusedWithAReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  struct Bad {
    std::function<void(PoseMessage&)> spoil;
    const char* words;
  };
  for (const Bad& bad : {Bad{[&](PoseMessage& p) { p.pose.x_m = nan; }, "no place"},
                         {[&](PoseMessage& p) { p.pose.y_m = -infinity; }, "no place"},
                         {[&](PoseMessage& p) { p.pose.x_m = 1e9; }, "no place"},
                         {[&](PoseMessage& p) { p.pose.qz = nan; }, "quaternion"},
                         {[&](PoseMessage& p) { p.pose.qz = p.pose.qw = 0.0; }, "quaternion"},
                         {[&](PoseMessage& p) { p.covariance[0] = infinity; }, "not finite"},
                         {[&](PoseMessage& p) { p.covariance[35] = nan; }, "not finite"},
                         {[&](PoseMessage& p) { p.covariance[7] = 1e12; }, "global_localization"},
                         {[&](PoseMessage& p) { p.covariance[7] = -1.0; }, "negative"},
                         {[&](PoseMessage& p) { p.covariance[1] = 1.0; }, "go along"},
                         {[&](PoseMessage& p) { p.frame_id = "odom"; }, "\"odom\""},
                         {[&](PoseMessage& p) { p.frame_id = ""; }, "Fixed Frame"}}) {
    PoseMessage pose = by_rviz();
    bad.spoil(pose);
    const auto guess = start_guess_of(pose, "map");
    ASSERT_FALSE(guess) << bad.words;
    EXPECT_THAT(to_string(guess.error()), HasSubstr(bad.words));
  }
}

TEST(StartGuess, WithoutCovarianceIsAPose) {
  PoseMessage pose = by_rviz();
  pose.covariance = {};
  const auto guess = start_guess_of(pose, "map");
  ASSERT_TRUE(guess) << guess.error();
  EXPECT_FALSE(guess->within);
}

TEST(StartGuess, OffTheMapIsRefused) {
  const Map room = FloorPlan{.walls = {{{2.0, 1.0}, {6.0, 1.0}, {6.0, 5.0}}}};
  EXPECT_TRUE(check_on_map({{4.0, 3.0, 0.0}, std::nullopt}, room));
  EXPECT_TRUE(check_on_map({{105.0, 3.0, 0.0}, std::nullopt}, room))
      << "a laser may see the walls from there";
  const auto off = check_on_map({{480.0, 3.0, 0.0}, std::nullopt}, room);
  ASSERT_FALSE(off);
  EXPECT_THAT(to_string(off.error()),
              HasSubstr("lies 474 m off the map, whose walls are between 2.0, 1.0 and 6.0, 5.0"));
  const auto region = [](double radius_m) {
    return StartGuess{{16.0, 3.0, 0.0}, SearchRegion{{16.0, 3.0}, radius_m}};
  };
  EXPECT_FALSE(check_on_map(region(9.0), room));
  EXPECT_TRUE(check_on_map(region(11.0), room));
}

TEST(StartGuess, TakesAFrameWithASlash) {
  PoseMessage pose = by_rviz();
  pose.frame_id = "/map";
  EXPECT_TRUE(start_guess_of(pose, "map"));
}

}  // namespace
}  // namespace beaconless::ros1
