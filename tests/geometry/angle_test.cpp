// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/angle.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

TEST(Angle, WrapIsHalfOpen) {
  EXPECT_EQ(wrap_angle(kPi), -kPi);
  EXPECT_EQ(wrap_angle(-kPi), -kPi);
  const double below = std::nextafter(kPi, 0.0);
  EXPECT_EQ(wrap_angle(below), below);
  EXPECT_EQ(wrap_angle(-below), -below);
  EXPECT_LT(wrap_angle(std::nextafter(-kPi, -4.0)), kPi);
  EXPECT_GT(wrap_angle(std::nextafter(-kPi, -4.0)), 3.14);
}

TEST(Angle, WrapStaysInsideAndKeepsTheDirection) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const double angle = rng.uniform(-1000.0, 1000.0);
    const double wrapped = wrap_angle(angle);
    ASSERT_GE(wrapped, -kPi);
    ASSERT_LT(wrapped, kPi);
    // 2 * kPi is off by 2.4e-16 from a turn, 160 turns at most; the rest is rounding at 1000.
    ASSERT_NEAR(std::cos(wrapped), std::cos(angle), 3e-13) << angle;
    ASSERT_NEAR(std::sin(wrapped), std::sin(angle), 3e-13) << angle;
  }
}

TEST(Angle, WrapLeavesAnAngleInsideAsItIs) {
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const double angle = rng.uniform(-kPi, kPi);
    ASSERT_EQ(wrap_angle(angle), angle);
  }
}

TEST(Angle, WrapTakesOffWholeTurns) {
  EXPECT_NEAR(wrap_angle(6.5), 0.2168, 5e-5);
  EXPECT_NEAR(wrap_angle(-6.5), -0.2168, 5e-5);
  EXPECT_NEAR(wrap_angle(7.0), 0.7168, 5e-5);
}

TEST(Angle, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(degrees(-kPi / 2.0), -90.0);
}

}  // namespace
}  // namespace beaconless
