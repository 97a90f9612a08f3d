// SPDX-License-Identifier: Apache-2.0
// Wheels against poses: heard once they have agreed, and told once when the two part.
#include "beaconless/track/way_check.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

constexpr double kStep_s = 0.1;
const Twist2 kStraight{1.0, 0.0, 0.0};
const Twist2 kCurve{0.8, 0.0, 0.4};
const Twist2 kStill{0.0, 0.0, 0.0};

/// A robot whose wheels and whose poses each tell a motion of their own.
class Way {
 public:
  /// Drives on for a time; how often the two were said to part.
  int drive(double for_s, const Twist2& by_wheels, const Twist2& by_poses) {
    int parted = 0;
    for (double left_s = for_s; left_s > 1e-6; left_s -= kStep_s) {
      for (int part = 0; part < kReadings; ++part) {
        wheels_ = wheels_ * Pose2::exp(kStep_s / kReadings * by_wheels);
        now_ns_ += static_cast<std::int64_t>(1e9 * kStep_s) / kReadings;
        odometry_.add({now_ns_}, wheels_);
      }
      pose_ = pose_ * Pose2::exp(kStep_s * by_poses);
      if (check.part({now_ns_}, pose_, odometry_)) ++parted;
    }
    return parted;
  }

  /// Wheels say nothing for a time, while the pose goes elsewhere.
  bool part_after_silence(double for_s, const Pose2& moved) {
    now_ns_ += static_cast<std::int64_t>(1e9 * for_s);
    pose_ = pose_ * moved;
    return check.part({now_ns_}, pose_, odometry_);
  }

  WayCheck check;

 private:
  static constexpr int kReadings = 5;

  OdometryTrack odometry_;
  Pose2 wheels_{7, 7, 2};
  Pose2 pose_{-1, 4, -1};
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST(WayCheck, WaysThatAgreeNeverPart) {
  Way way;
  EXPECT_EQ(way.drive(20.0, kStraight, kStraight), 0);
  EXPECT_EQ(way.drive(20.0, kCurve, kCurve), 0);
  EXPECT_EQ(way.drive(20.0, kStill, kStill), 0);
}

TEST(WayCheck, WheelsThatSlipALittleNeverPart) {
  Way way;
  EXPECT_EQ(way.drive(40.0, {1.05, 0.0, 0.02}, kStraight), 0);
  EXPECT_EQ(way.drive(20.0, {1.2, 0.0, 0.0}, kStraight), 0) << "far more than that is meant by parting";
}

TEST(WayCheck, WheelsThatAgreedAndThenPartAreToldOnce) {
  for (const Twist2& by_poses :
       {kStill, Twist2{0.4, 0.0, 0.0}, Twist2{1.0, 0.0, 0.5}, Twist2{-1.0, 0.0, 0.0}}) {
    Way way;
    ASSERT_EQ(way.drive(5.0, kStraight, kStraight), 0);
    EXPECT_EQ(way.drive(20.0, kStraight, by_poses), 1) << by_poses.vector().transpose();
  }
}

TEST(WayCheck, APoseThatSlidesWhileWheelsStandIsToldToo) {
  Way way;
  ASSERT_EQ(way.drive(5.0, kStraight, kStraight), 0);
  EXPECT_EQ(way.drive(5.0, kStill, kStraight), 1);
}

TEST(WayCheck, WheelsThatAgreeAgainAreHeardAgain) {
  Way way;
  way.drive(5.0, kStraight, kStraight);
  ASSERT_EQ(way.drive(5.0, kStraight, kStill), 1);
  EXPECT_EQ(way.drive(5.0, kStraight, kStraight), 0);
  EXPECT_EQ(way.drive(5.0, kStraight, kStill), 1);
}

TEST(WayCheck, WheelsThatSlipFromTheBeginningAreNeverHeard) {
  Way way;
  EXPECT_EQ(way.drive(60.0, {2.0, 0.0, 0.0}, kStraight), 0);
  EXPECT_EQ(way.drive(60.0, {1.0, 0.0, 0.5}, kStraight), 0);
}

TEST(WayCheck, OneStretchThatAgreesIsNotEnough) {
  Way way;
  ASSERT_EQ(way.drive(1.2, kStraight, kStraight), 0);
  EXPECT_EQ(way.drive(20.0, kStraight, kStill), 0);
}

TEST(WayCheck, ABeginningForgetsThatWheelsAgreed) {
  Way way;
  way.drive(5.0, kStraight, kStraight);
  way.check.begin();
  EXPECT_EQ(way.drive(20.0, kStraight, kStill), 0);
  EXPECT_EQ(way.drive(5.0, kStraight, kStraight), 0);
  EXPECT_EQ(way.drive(5.0, kStraight, kStill), 1) << "but they can agree anew";
}

TEST(WayCheck, ABeginningForgetsTheStretchToo) {
  Way way;
  way.drive(5.5, kStraight, kStraight);
  way.check.begin();
  EXPECT_EQ(way.drive(0.1, kStraight, {1.0, 4.0, 0.0}), 0) << "it was put elsewhere, not far";
  EXPECT_EQ(way.drive(2.3, kStraight, kStraight), 0);
  EXPECT_EQ(way.drive(5.0, kStraight, kStill), 1) << "that is no stretch in which they did not agree";
}

TEST(WayCheck, WhatHappensWhileWheelsAreSilentIsNotTheirs) {
  Way way;
  way.drive(5.0, kStraight, kStraight);
  EXPECT_FALSE(way.part_after_silence(60.0, {30.0, 0.0, 1.0}));
  EXPECT_EQ(way.drive(5.0, kStraight, kStraight), 0);
}

}  // namespace
}  // namespace beaconless
