// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/motion_filter.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace beaconless
