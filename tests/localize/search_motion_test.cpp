// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/search_motion.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

const Pose2 kBaseFromLaser{0.3, -0.1, 0.7};
constexpr double kRounding = 1e-12;

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_LT(distance_m(a, b), kRounding);
  EXPECT_LT(heading_difference_rad(a, b), kRounding);
}

TEST(SearchMotion, StandsUntilSomethingIsTold) {
  SearchMotion motion(kBaseFromLaser);
  EXPECT_FALSE(motion.expect(std::nullopt));
  EXPECT_EQ(motion.motion().per_s, Eigen::Vector3d::Zero());
  EXPECT_FALSE(motion.way(0.1));
}

TEST(SearchMotion, AWayThatAPlaceToldGoesOn) {
  SearchMotion motion(kBaseFromLaser);
  motion.expect(std::nullopt);
  const Pose2 moved{0.02, 0.01, 0.1};
  motion.hear(moved, 0.1);
  EXPECT_TRUE(motion.expect(std::nullopt)) << "the scan before was seen without it";
  ASSERT_TRUE(motion.way(0.1));
  expect_near(*motion.way(0.1), moved);
  expect_near(*motion.way(0.2), moved * moved);
  EXPECT_FALSE(motion.expect(std::nullopt)) << "known before already";
}

TEST(SearchMotion, WheelsAreHeardFirst) {
  SearchMotion motion(kBaseFromLaser);
  motion.expect(std::nullopt);
  motion.hear(Pose2{0.5, 0.0, 0.0}, 0.1);
  motion.expect(ToldTwist{{1.0, 0.0, 0.2}, Eigen::Matrix3d::Zero()});
  ASSERT_TRUE(motion.way(0.5));
  expect_near(*motion.way(0.5), kBaseFromLaser.inverse() * Pose2::exp({0.5, 0.0, 0.1}) * kBaseFromLaser);
}

TEST(SearchMotion, ForgetsWhereNoPlaceTellsOrNoTimeHasPassed) {
  SearchMotion motion(kBaseFromLaser);
  for (const auto& [moved, seconds] :
       {std::pair{std::optional<Pose2>(), 0.1}, std::pair{std::optional(Pose2{0.1, 0.0, 0.0}), 0.0}}) {
    motion.hear(Pose2{0.1, 0.0, 0.0}, 0.1);
    motion.hear(moved, seconds);
    motion.expect(std::nullopt);
    EXPECT_FALSE(motion.way(0.1));
  }
}

}  // namespace
}  // namespace beaconless
