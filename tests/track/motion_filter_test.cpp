// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

const Twist2 kTwistPerS{0.7, 0.02, 0.4};

Stamp at(double seconds) { return Stamp::from_seconds(seconds); }

MotionFilter moving_since_zero() {
  MotionFilter filter;
  filter.start_at({1, 2, 0.5});
  for (const double t : {0.0, 0.1, 0.2})
    filter.correct(at(t), Pose2{1, 2, 0.5} * Pose2::exp(t * kTwistPerS), Eigen::Matrix3d::Zero());
  return filter;
}

TEST(MotionFilter, CarriesAConstantTwistOnWhateverTheInterval) {
  const MotionFilter filter = moving_since_zero();
  for (const double t : {0.21, 0.3, 0.7}) {
    const Prediction prediction = filter.predict(at(t));
    const Pose2 truth = Pose2{1, 2, 0.5} * Pose2::exp(t * kTwistPerS);
    EXPECT_LT(distance_m(prediction.map_from_base, truth), 1e-9) << t;
    EXPECT_LT(heading_difference_rad(prediction.map_from_base, truth), 1e-9);
    EXPECT_NEAR(prediction.motion.per_s.x(), kTwistPerS.x_m, 1e-9);
  }
}

TEST(MotionFilter, IsLessSureTheFurtherItLooks) {
  const MotionFilter filter = moving_since_zero();
  const auto near = filter.predict(at(0.25)).covariance;
  const auto far = filter.predict(at(0.6)).covariance;
  for (int i = 0; i < 3; ++i) EXPECT_GT(far(i, i), near(i, i));
}

TEST(MotionFilter, StandsWhereItWasAfterALongSilence) {
  const MotionFilter filter = moving_since_zero();
  EXPECT_EQ(filter.predict(at(5.0)).map_from_base, filter.predict(at(500.0)).map_from_base);
  EXPECT_LT(
      distance_m(filter.predict(at(5.0)).map_from_base, Pose2{1, 2, 0.5} * Pose2::exp(0.2 * kTwistPerS)),
      1e-12);
}

TEST(MotionFilter, RepeatsTheLastStepWhereStampsStandStillOrRunBackwards) {
  const MotionFilter filter = moving_since_zero();
  const Pose2 next = Pose2{1, 2, 0.5} * Pose2::exp(0.3 * kTwistPerS);
  for (const double t : {0.2, 0.1, -7.0})
    EXPECT_LT(distance_m(filter.predict(at(t)).map_from_base, next), 1e-9) << t;
}

TEST(MotionFilter, BeforeAnyScanIsAtTheStart) {
  MotionFilter filter;
  filter.start_at({3, 4, 1});
  EXPECT_EQ(filter.predict(at(99)).map_from_base, (Pose2{3, 4, 1}));
}

constexpr double kStep_s = 0.025;

Eigen::Matrix3d pose_noise(double sigma) { return sigma * sigma * Eigen::Matrix3d::Identity(); }

/// A robot that drives with a known twist and is seen every kStep_s.
struct Driven {
  explicit Driven(const MotionConfig& config = {}) : filter(config) { filter.start_at(pose); }
  void drive(const Twist2& per_s, int steps, double sigma = 0.002) {
    for (int i = 0; i < steps; ++i) {
      now = now + kStep_s;
      pose = pose * Pose2::exp(kStep_s * per_s);
      filter.correct(now, pose, pose_noise(sigma));
    }
  }
  double speed_sigma() const { return std::sqrt(filter.motion_at(now + kStep_s).covariance(0, 0)); }

  Stamp now{1'411'657'682'000'000'000};
  Pose2 pose{1, 2, 0.5};
  MotionFilter filter;
};

TEST(MotionFilter, TwoPosesTellTheMeanVelocityBetweenThem) {
  MotionFilter filter;
  filter.start_at({1, 2, 0.5});
  EXPECT_FALSE(filter.told_by(at(0.0), {1, 2, 0.5}, pose_noise(0.01))) << "one pose tells none";
  filter.correct(at(0.0), {1, 2, 0.5}, pose_noise(0.003));
  const Pose2 next = Pose2{1, 2, 0.5} * Pose2::exp(0.2 * kTwistPerS);
  const auto told = filter.told_by(at(0.2), next, pose_noise(0.004));
  ASSERT_TRUE(told);
  EXPECT_LT((told->per_s - kTwistPerS.vector()).norm(), 1e-9);
  EXPECT_LT((told->covariance - pose_noise(0.005 / 0.2)).norm(), 1e-12) << "both poses are noisy";
}

TEST(MotionFilter, WhatIsUnsureInTheMapIsUnsureInTheBase) {
  MotionFilter filter;
  filter.start_at({0, 0, radians(90.0)});
  filter.correct(at(0.0), {0, 0, radians(90.0)}, Eigen::Matrix3d::Zero());
  const Eigen::Matrix3d unsure_in_y = Eigen::Vector3d(0.0, 0.01, 0.0).asDiagonal();
  const auto told = filter.told_by(at(1.0), {0, 1, radians(90.0)}, unsure_in_y);
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->per_s.x(), 1.0, 1e-12);
  EXPECT_NEAR(told->covariance(0, 0), 0.01, 1e-12) << "ahead is y of the map";
  EXPECT_NEAR(told->covariance(1, 1), 0.0, 1e-12);
}

TEST(MotionFilter, HearsAVelocityThatIsPossible) {
  Driven robot;
  robot.drive(kTwistPerS, 40);
  const ToldTwist before = robot.filter.motion_at(robot.now);
  const ToldTwist told{kTwistPerS.vector() + Eigen::Vector3d(0.03, 0, 0), pose_noise(0.005)};
  ASSERT_TRUE(robot.filter.hear(told, kStep_s));
  const ToldTwist after = robot.filter.motion_at(robot.now);
  EXPECT_GT(after.per_s.x(), before.per_s.x() + 0.01);
  EXPECT_LE(after.per_s.x(), told.per_s.x());
}

/// Wheels that are off by a few percent must not make a steady motion look as if it changed.
TEST(MotionFilter, TheNoiseOfWhatIsHeardIsNoChangeOfTheMotion) {
  constexpr double kScan_s = 0.125;
  Rng rng(32);
  Driven robot;
  robot.drive(kTwistPerS, 80);
  double square_sum = 0.0;
  for (int scan = 0; scan < 200; ++scan) {
    const Eigen::Vector3d off(rng.normal(0.05), rng.normal(0.05), rng.normal(0.05));
    EXPECT_TRUE(robot.filter.hear({kTwistPerS.vector() + off, pose_noise(0.05)}, kScan_s));
    square_sum += (robot.filter.motion_at(robot.now).per_s - kTwistPerS.vector()).squaredNorm();
    robot.now = robot.now + kScan_s;
    robot.pose = robot.pose * Pose2::exp(kScan_s * kTwistPerS);
    robot.filter.correct(robot.now, robot.pose, pose_noise(0.0005));
  }
  EXPECT_LT(std::sqrt(square_sum / 200), 0.04) << "0.03 was measured; the wheels are off by 0.09";
}

TEST(MotionFilter, AChangeThatIsHeardIsBelievedAtOnce) {
  Driven robot;
  robot.drive(kTwistPerS, 80);
  const Eigen::Vector3d faster = kTwistPerS.vector() + Eigen::Vector3d(0.1, 0, 0);
  ASSERT_TRUE(robot.filter.hear({faster, pose_noise(0.005)}, 0.1));
  EXPECT_NEAR(robot.filter.motion_at(robot.now).per_s.x(), faster.x(), 0.03);
}

TEST(MotionFilter, DoesNotHearWhatIsImpossible) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  Driven robot;
  robot.drive(kTwistPerS, 40);
  const Prediction before = robot.filter.predict(robot.now + kStep_s);
  // 1 m/s and 1.5 rad/s of change in a second, and one scan has gone by.
  for (const Eigen::Vector3d& off : {Eigen::Vector3d(1, 0, 0),
                                     {-0.7, 0, 0},
                                     {0, 0.5, 0},
                                     {0, 0, 1},
                                     {20, 0, 0},
                                     {nan, 0, 0},
                                     {0, 0, inf}}) {
    EXPECT_FALSE(robot.filter.hear({kTwistPerS.vector() + off, pose_noise(0.02)}, kStep_s)) << off;
    const Prediction after = robot.filter.predict(robot.now + kStep_s);
    EXPECT_EQ(after.map_from_base, before.map_from_base);
    EXPECT_EQ(after.covariance, before.covariance);
  }
  EXPECT_TRUE(robot.filter.hear({kTwistPerS.vector() + Eigen::Vector3d(1, 0, 0), pose_noise(1.0)}, kStep_s))
      << "said with so much doubt it is possible";
}

TEST(MotionFilter, BeforeThePosesTellAnythingAnyUsualVelocityIsHeard) {
  MotionFilter filter;
  filter.start_at({0, 0, 0});
  filter.correct(at(0.0), {0, 0, 0}, pose_noise(0.01));
  EXPECT_TRUE(filter.hear({{1.5, 0, 1.5}, pose_noise(0.02)}, 0.1));
  EXPECT_NEAR(filter.motion_at(at(0.1)).per_s.x(), 1.5, 0.01);
}

TEST(MotionFilter, ASteadyRobotIsSureOfItsSpeedAndAfterAChangeAtOnceNotAnyMore) {
  Driven robot;
  robot.drive(kTwistPerS, 80);
  const double steady = robot.speed_sigma();
  EXPECT_LT(steady, 0.02) << "m/s; two poses of 2 mm tell it to 0.11 only";
  robot.drive({0.0, 0.0, 0.0}, 1);
  const double braked = robot.speed_sigma();
  EXPECT_GT(braked, 2.0 * steady);
  EXPECT_GT(braked, 0.9 * kStep_s) << "all that an acceleration of 1 m/s2 can do";
  robot.drive({0.0, 0.0, 0.0}, 80);
  EXPECT_LT(robot.speed_sigma(), 1.2 * steady) << "and calms down";
  EXPECT_NEAR(robot.filter.motion_at(robot.now).per_s.x(), 0.0, 0.01);
}

TEST(MotionFilter, ATurnDoesNotMakeTheSpeedUnsureNorASpeedTheTurn) {
  Driven turning;
  turning.drive(kTwistPerS, 80);
  const ToldTwist before = turning.filter.motion_at(turning.now);
  turning.drive({0.7, 0.02, 1.2}, 1);
  const ToldTwist after = turning.filter.motion_at(turning.now);
  EXPECT_GT(after.covariance(2, 2), 4.0 * before.covariance(2, 2));
  EXPECT_LT(after.covariance(0, 0), 1.5 * before.covariance(0, 0));
}

TEST(MotionFilter, APoseThatRestsOnItsPredictionMakesTheSpeedUnsure) {
  Driven robot;
  robot.drive(kTwistPerS, 80);
  const double before = robot.speed_sigma();
  const ToldTwist motion = robot.filter.motion_at(robot.now);
  robot.now = robot.now + kStep_s;
  robot.filter.hold(robot.now, robot.pose, pose_noise(0.002));
  EXPECT_GT(robot.speed_sigma(), 1.5 * before);
  EXPECT_EQ(robot.filter.motion_at(robot.now).per_s, motion.per_s);
}

TEST(MotionFilter, APredictionAllowsForEveryPossibleAcceleration) {
  const MotionConfig config{.acceleration_mps2 = 2.0, .turn_acceleration_radps2 = 3.0};
  Driven robot(config);
  for (int round = 0; round < 50; ++round) {
    robot.drive(round % 10 == 9 ? Twist2{-0.3, 0, 1} : kTwistPerS, 4);
    for (const double dt : {0.001, 0.025, 0.2, 0.9}) {
      const Eigen::Matrix3d covariance = robot.filter.predict(robot.now + dt).covariance;
      EXPECT_GE(std::sqrt(covariance(0, 0)), 2.0 * dt * dt) << dt;
      EXPECT_GE(std::sqrt(covariance(1, 1)), 2.0 * dt * dt) << dt;
      EXPECT_GE(std::sqrt(covariance(2, 2)), 3.0 * dt * dt) << dt;
    }
  }
}

TEST(MotionFilter, AfterALongSilenceTheMeanSinceTellsNotHowFastItIsNow) {
  Driven robot;
  robot.drive(kTwistPerS, 80);
  robot.now = robot.now + 100.0;
  robot.filter.correct(robot.now, robot.pose, pose_noise(0.002));  // it stands where it stood
  EXPECT_GT(robot.speed_sigma(), 0.5) << "or has just come back";
  EXPECT_EQ(robot.filter.predict(robot.now).map_from_base,
            robot.filter.predict(robot.now + kStep_s).map_from_base)
      << "a stamp that repeats stands for the step that was usual, not for the silence";
  robot.drive(kTwistPerS, 40);
  EXPECT_NEAR(robot.filter.motion_at(robot.now).per_s.x(), kTwistPerS.x_m, 0.02);
}

void expect_sound(const Eigen::Matrix3d& covariance) {
  ASSERT_TRUE(covariance.allFinite());
  ASSERT_LE((covariance - covariance.transpose()).norm(), 1e-12 * covariance.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  ASSERT_GE(eigen.eigenvalues().minCoeff(), -1e-12 * std::abs(eigen.eigenvalues().maxCoeff())) << covariance;
}

/// Covariances of all sizes, some of them zero along some directions or wholly.
Eigen::Matrix3d any_covariance(Rng& rng) {
  Eigen::Matrix3d root = Eigen::Matrix3d::Zero();
  const int rank = static_cast<int>(rng.uniform(0.0, 4.0));
  for (int i = 0; i < rank; ++i)
    for (int k = 0; k < 3; ++k) root(k, i) = std::pow(10.0, rng.uniform(-7.0, 2.0)) * rng.normal(1.0);
  return root * root.transpose();
}

Stamp any_stamp(Stamp now, Rng& rng) {
  const double kind = rng.uniform();
  if (kind < 0.6) return now + rng.uniform(0.0, 0.2);
  if (kind < 0.7) return now;
  if (kind < 0.8) return now + -rng.uniform(0.0, 0.2);
  if (kind < 0.9) return Stamp{now.ns + 1};
  return now + rng.uniform(-1e4, 1e4);
}

TEST(MotionFilter, StaysSoundWhateverItIsTold) {
  Rng rng(31);
  for (int sequence = 0; sequence < 10'000; ++sequence) {
    MotionConfig config;
    if (sequence % 4 == 1) config.acceleration_mps2 = config.turn_acceleration_radps2 = 0.0;
    if (sequence % 4 == 2) config.acceleration_mps2 = config.turn_acceleration_radps2 = 100.0;
    if (sequence % 4 == 3) config.max_gap_s = sequence % 8 == 3 ? 0.0 : 1e6;
    MotionFilter filter(config);
    filter.start_at({rng.uniform(-1e3, 1e3), 0, rng.uniform(-4, 4)});
    Stamp now{1'411'657'682'000'000'000};
    for (int step = 0; step < 20; ++step) {
      now = any_stamp(now, rng);
      const Pose2 pose{rng.normal(3.0), rng.normal(3.0), rng.uniform(-4, 4)};
      const Eigen::Matrix3d covariance = any_covariance(rng);
      const ToldTwist told{{rng.normal(1.0), rng.normal(1.0), rng.normal(1.0)}, any_covariance(rng)};
      const double kind = rng.uniform();
      if (kind < 0.5) {
        filter.correct(now, pose, covariance);
      } else if (kind < 0.7) {
        filter.hold(now, pose, covariance);
      } else {
        filter.hear(told, rng.uniform(0.0, 0.2));
      }
      const Stamp next = any_stamp(now, rng);
      const Prediction prediction = filter.predict(next);
      ASSERT_TRUE(prediction.map_from_base.is_finite());
      ASSERT_TRUE(prediction.motion.per_s.allFinite());
      ASSERT_NO_FATAL_FAILURE(expect_sound(prediction.covariance)) << sequence << " " << step;
      ASSERT_NO_FATAL_FAILURE(expect_sound(prediction.motion.covariance)) << sequence << " " << step;
      if (const auto two = filter.told_by(next, pose, covariance)) {
        ASSERT_TRUE(two->per_s.allFinite());
        ASSERT_NO_FATAL_FAILURE(expect_sound(two->covariance)) << sequence << " " << step;
      }
    }
  }
}

}  // namespace
}  // namespace beaconless
