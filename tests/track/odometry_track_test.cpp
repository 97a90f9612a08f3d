// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/odometry_track.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

constexpr std::int64_t kStart_ns = 1'411'657'682'000'000'000;
constexpr std::int64_t kMs = 1'000'000;
const Twist2 kTwistPerS{0.8, 0.05, 0.6};

Stamp at_ms(std::int64_t ms) { return {kStart_ns + ms * kMs}; }

Pose2 pose_at_ms(std::int64_t ms, const Twist2& per_s = kTwistPerS) {
  return Pose2{40, -3, 2.9} * Pose2::exp(1e-3 * static_cast<double>(ms) * per_s);
}

/// Odometry every `step_ms` of a robot with a constant twist.
void drive(OdometryTrack& track, std::int64_t from_ms, std::int64_t to_ms, std::int64_t step_ms,
           const Twist2& per_s = kTwistPerS) {
  for (std::int64_t ms = from_ms; ms <= to_ms; ms += step_ms) track.add(at_ms(ms), pose_at_ms(ms, per_s));
}

ToldTwist seen(const Eigen::Vector3d& per_s, double sigma = 0.02) {
  return {per_s, sigma * sigma * Eigen::Matrix3d::Identity()};
}

void expect_told(const OdometryTrack& track, std::int64_t from_ms, std::int64_t to_ms,
                 const Eigen::Vector3d& per_s) {
  const auto told = track.between(at_ms(from_ms), at_ms(to_ms));
  ASSERT_TRUE(told) << from_ms << " " << to_ms;
  EXPECT_LT((told->per_s - per_s).norm(), 1e-6) << from_ms << " to " << to_ms << ": " << told->per_s;
}

TEST(OdometryTrack, TellsTheMeanTwistBetweenAnyTwoMoments) {
  OdometryTrack track;
  drive(track, 0, 1000, 20);
  for (const auto& [from, to] : {std::pair{0, 1000}, {0, 20}, {3, 4}, {17, 23}, {101, 999}, {980, 1000}})
    expect_told(track, from, to, kTwistPerS.vector());
}

TEST(OdometryTrack, WhereSpeedsDifferTheMeanIsBetweenThem) {
  OdometryTrack track;
  track.add(at_ms(0), {0, 0, 0});
  track.add(at_ms(100), {0.1, 0, 0});  // 1 m/s
  track.add(at_ms(300), {0.7, 0, 0});  // 3 m/s
  expect_told(track, 0, 100, {1, 0, 0});
  expect_told(track, 150, 250, {3, 0, 0});
  expect_told(track, 50, 150, {2, 0, 0});
  expect_told(track, 0, 300, {7.0 / 3.0, 0, 0});
}

TEST(OdometryTrack, TheMotionIsThatOfTheBaseWhateverItsHeading) {
  OdometryTrack track;
  track.add(at_ms(0), {5, 5, radians(90.0)});
  track.add(at_ms(100), {5, 5.1, radians(90.0)});
  expect_told(track, 0, 100, {1, 0, 0});
}

TEST(OdometryTrack, AFasterMotionIsLessSure) {
  OdometryTrack slow;
  OdometryTrack fast;
  drive(slow, 0, 200, 20, {0.2, 0, 0.1});
  drive(fast, 0, 200, 20, {2.0, 0, 1.0});
  const auto told_slow = slow.between(at_ms(0), at_ms(200));
  const auto told_fast = fast.between(at_ms(0), at_ms(200));
  ASSERT_TRUE(told_slow && told_fast);
  for (int i = 0; i < 3; ++i) EXPECT_GT(told_fast->covariance(i, i), told_slow->covariance(i, i));
  EXPECT_NEAR(told_fast->covariance(0, 0), 0.02 * 0.02 + 0.1 * 0.1, 1e-9) << "5 % of 2 m/s";
  EXPECT_NEAR(told_fast->covariance(2, 2), 0.01 * 0.01 + 0.05 * 0.05, 1e-9);
}

TEST(OdometryTrack, TellsNothingWhereLessThanHalfIsCovered) {
  OdometryTrack track;
  drive(track, 0, 1000, 20);
  expect_told(track, 900, 1100, kTwistPerS.vector());
  expect_told(track, -100, 101, kTwistPerS.vector());
  EXPECT_FALSE(track.between(at_ms(900), at_ms(1101)));
  EXPECT_FALSE(track.between(at_ms(-102), at_ms(100)));
  EXPECT_FALSE(track.between(at_ms(1000), at_ms(1100))) << "what comes is not known";
  EXPECT_FALSE(track.between(at_ms(-500), at_ms(0)));
  EXPECT_FALSE(track.between(at_ms(5000), at_ms(5100)));
}

TEST(OdometryTrack, TellsNothingBetweenMomentsThatAreOneOrTheWrongWayRound) {
  OdometryTrack track;
  drive(track, 0, 1000, 20);
  EXPECT_FALSE(track.between(at_ms(500), at_ms(500)));
  EXPECT_FALSE(track.between(at_ms(600), at_ms(500)));
  EXPECT_FALSE(track.between(at_ms(500), {at_ms(500).ns + 50'000}));
}

TEST(OdometryTrack, TellsNothingBeforeTwoEntries) {
  OdometryTrack track;
  EXPECT_FALSE(track.between(at_ms(0), at_ms(100)));
  track.add(at_ms(50), {1, 0, 0});
  EXPECT_FALSE(track.between(at_ms(0), at_ms(100)));
  track.add(at_ms(150), {1.1, 0, 0});
  EXPECT_TRUE(track.between(at_ms(50), at_ms(150)));
}

TEST(OdometryTrack, WhatNeverMovedTellsNothing) {
  OdometryTrack track;
  for (int i = 0; i < 50; ++i) track.add(at_ms(20 * i), {40, -3, 2.9});
  EXPECT_FALSE(track.between(at_ms(0), at_ms(500)));
  track.add(at_ms(1000), {40.02, -3, 2.9});
  EXPECT_TRUE(track.between(at_ms(0), at_ms(500))) << "it stood, but it works";
}

/// Wheels that report 200 times a second move millimetres from one report to the next.
TEST(OdometryTrack, ASlowRobotWithFastWheelsHasMoved) {
  for (const Twist2& per_s : {Twist2{0.5, 0, 0}, Twist2{0, 0, 0.5}}) {
    OdometryTrack track;
    drive(track, 0, 1000, 5, per_s);
    expect_told(track, 100, 900, per_s.vector());
  }
}

TEST(OdometryTrack, AStampThatRunsBackwardsBeginsAnew) {
  OdometryTrack track;
  drive(track, 0, 1000, 20);
  track.add(at_ms(300), {-7, 0, 0});
  EXPECT_FALSE(track.between(at_ms(100), at_ms(300))) << "one entry";
  track.add(at_ms(400), {-6.9, 0, 0});
  expect_told(track, 300, 400, {1, 0, 0});
  EXPECT_FALSE(track.between(at_ms(100), at_ms(310))) << "what was before is gone";

  track.add(at_ms(400), {0, 0, 0});  // and so does one that stands still
  EXPECT_FALSE(track.between(at_ms(300), at_ms(400)));
}

TEST(OdometryTrack, RemembersTheLast256) {
  OdometryTrack track;
  drive(track, 0, 10'000, 10);  // 1001 entries
  expect_told(track, 10'000 - 2550, 10'000, kTwistPerS.vector());
  expect_told(track, 10'000 - 2550, 10'000 - 2545, kTwistPerS.vector());
  EXPECT_FALSE(track.between(at_ms(10'000 - 2580), at_ms(10'000 - 2556)));
}

TEST(OdometryTrack, PosesThatAreNotFiniteAreNotHeard) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  OdometryTrack track;
  for (std::int64_t ms = 0; ms <= 1000; ms += 20) {
    track.add(at_ms(ms), pose_at_ms(ms));
    track.add(at_ms(ms + 5), {nan, 0, 0});
    track.add(at_ms(ms + 6), {0, inf, 0});
    track.add(at_ms(ms + 7), {0, 0, -nan});
  }
  expect_told(track, 13, 787, kTwistPerS.vector());
}

TEST(OdometryTrack, NotToBeUsedTellsNothingAndIsNeverTrusted) {
  OdometryTrack track({.use = false});
  drive(track, 0, 1000, 20);
  EXPECT_FALSE(track.between(at_ms(100), at_ms(200)));
  for (int i = 0; i < 10; ++i) track.compare(at_ms(100), at_ms(200), seen(kTwistPerS.vector()));
  EXPECT_FALSE(track.is_trusted());
}

/// Odometry for the tests of trust, and what the laser saw.
class OdometryTrust : public testing::Test {
 protected:
  void SetUp() override { drive(track, 0, 2000, 20); }
  void agree(int times) {
    for (int i = 0; i < times; ++i) track.compare(at_ms(100), at_ms(200), seen(kTwistPerS.vector()));
  }
  void disagree() {
    track.compare(at_ms(100), at_ms(200), seen(kTwistPerS.vector() + Eigen::Vector3d(0.5, 0, 0)));
  }
  /// Comparisons that agree until it is trusted again.
  int agreements_needed() {
    int count = 0;
    for (; !track.is_trusted() && count < 1000; ++count) agree(1);
    return count;
  }
  OdometryTrack track;
};

TEST_F(OdometryTrust, IsMadeByFiveComparisonsThatAgree) {
  EXPECT_FALSE(track.is_trusted());
  agree(4);
  EXPECT_FALSE(track.is_trusted());
  agree(1);
  EXPECT_TRUE(track.is_trusted());
}

TEST_F(OdometryTrust, IsLostByOneThatDoesNotAndRegainedLater) {
  agree(500);
  disagree();
  EXPECT_FALSE(track.is_trusted());
  EXPECT_GT(agreements_needed(), 20) << "who lied is not believed as soon as a stranger";
  disagree();
  EXPECT_LT(agreements_needed(), 40) << "but one day";
}

TEST_F(OdometryTrust, IsLostWhereItTellsNothing) {
  agree(10);
  track.compare(at_ms(9000), at_ms(9100), seen(kTwistPerS.vector()));
  EXPECT_FALSE(track.is_trusted());
  EXPECT_EQ(agreements_needed(), 5);
}

TEST_F(OdometryTrust, ASilenceDoesNotWashALieAway) {
  disagree();
  track.compare(at_ms(9000), at_ms(9100), seen(kTwistPerS.vector()));
  EXPECT_GT(agreements_needed(), 20);
}

TEST_F(OdometryTrust, AnUnsureLookDoesNotDisagree) {
  agree(5);
  const Eigen::Vector3d off = kTwistPerS.vector() + Eigen::Vector3d(0.5, 0, 0);
  track.compare(at_ms(100), at_ms(200), seen(off, 0.5));
  EXPECT_TRUE(track.is_trusted());
  track.compare(at_ms(100), at_ms(200), seen(off, 0.02));
  EXPECT_FALSE(track.is_trusted());
}

TEST_F(OdometryTrust, IsNotMadeOfNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 10; ++i) track.compare(at_ms(100), at_ms(200), seen({nan, 0, 0}));
  EXPECT_FALSE(track.is_trusted());
}

TEST_F(OdometryTrust, ComesWithoutNoiseToo) {
  OdometryTrack exact({.share = 0.0, .sigma_mps = 0.0, .sigma_radps = 0.0});
  drive(exact, 0, 1000, 20);
  for (int i = 0; i < 5; ++i) exact.compare(at_ms(100), at_ms(200), seen(kTwistPerS.vector(), 0.0));
  EXPECT_TRUE(exact.is_trusted());
}

TEST(OdometryTrack, AllocatesNothing) {
  OdometryTrack track;
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  drive(track, 0, 10'000, 10);
  for (int i = 0; i < 100; ++i) {
    track.between(at_ms(8000 + i), at_ms(9000));
    track.compare(at_ms(9000), at_ms(9100), seen(kTwistPerS.vector()));
  }
  EXPECT_EQ(test::allocations(), before);
  EXPECT_TRUE(track.is_trusted());
}

}  // namespace
}  // namespace beaconless
