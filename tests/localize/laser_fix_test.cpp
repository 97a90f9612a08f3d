// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/laser_fix.hpp"

#include <gtest/gtest.h>

namespace beaconless {
namespace {

/// Straight on at 1 m/s, a pose every tenth of a second; wheels at 50 Hz that say so too, or nothing.
class LaserFixTest : public testing::Test {
 protected:
  static constexpr double kSpeed_mps = 1.0;

  static Stamp at(double seconds_s) { return Stamp::from_seconds(seconds_s); }

  void drive(bool has_wheels) {
    fix_.start_at({});
    for (int i = 0; i <= 100; ++i) {
      const double now_s = 0.02 * i;
      if (has_wheels) hear(now_s, 0.0);
      if (i % 5 == 0) take(now_s);
    }
  }

  void hear(double now_s, double off_m) {
    fix_.hear({at(now_s), {kSpeed_mps * now_s + off_m, 0.0, 0.0}, {}, "odom"});
  }

  void take(double now_s, bool has_jumped = false) {
    PoseEstimate estimate;
    estimate.stamp = at(now_s);
    estimate.map_from_base = {kSpeed_mps * now_s, 0.0, 0.0};
    estimate.covariance = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
    estimate.status = Status::ok;
    estimate.jumped = has_jumped;
    fix_.take(estimate);
  }

  LaserFix fix_{MotionConfig{}, OdometryConfig{}};
};

TEST_F(LaserFixTest, IsCarriedByTheMotionOfItsPosesForwardsAndBack) {
  drive(false);
  EXPECT_NEAR(fix_.at(at(2.05)).pose.x_m, 2.05, 1e-3);
  EXPECT_NEAR(fix_.at(at(1.95)).pose.x_m, 1.95, 1e-3);
  EXPECT_EQ(fix_.at(at(2.0)).pose.x_m, 2.0);
  EXPECT_NEAR(fix_.at(at(2.0)).covariance(0, 0), 1e-6, 1e-12);
  EXPECT_GT(fix_.at(at(2.05)).covariance(0, 0), 2e-6);
}

/// The robot brakes after its last pose: only the wheels know.
TEST_F(LaserFixTest, IsCarriedByWheelsThatAgreeWithIt) {
  drive(true);
  fix_.hear({at(2.02), {2.015, 0.0, 0.0}, {}, "odom"});
  fix_.hear({at(2.06), {2.045, 0.0, 0.0}, {}, "odom"});
  EXPECT_NEAR(fix_.at(at(2.06)).pose.x_m, 2.045, 1e-6);
}

TEST_F(LaserFixTest, IsNotCarriedByWheelsThatWereSetAnew) {
  drive(true);
  hear(2.02, 3.0), hear(2.04, 3.0);
  EXPECT_NEAR(fix_.at(at(2.04)).pose.x_m, 2.04, 2e-3);
}

TEST_F(LaserFixTest, LearnsItsMotionAnewAfterAJump) {
  drive(false);
  PoseEstimate far;
  far.stamp = at(2.1);
  far.map_from_base = {50.0, 0.0, 0.0};
  far.covariance = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  far.status = Status::ok;
  far.jumped = true;
  fix_.take(far);
  EXPECT_LT(fix_.at(at(2.15)).pose.x_m, 50.2);
}

}  // namespace
}  // namespace beaconless
