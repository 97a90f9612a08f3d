// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/lidar.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/scan/scan.hpp"

namespace beaconless::sim {
namespace {

const FloorPlan kRoom{{{{-5.0, -4.0}, {5.0, -4.0}, {5.0, 4.0}, {-5.0, 4.0}, {-5.0, -4.0}}}};
constexpr float kInfinity = std::numeric_limits<float>::infinity();

LaserMotion stands_at(const Pose2& pose) {
  return [pose](double) { return pose; };
}

LidarConfig without_noise() {
  LidarConfig config;
  config.range_sigma_m = 0.0;
  config.range_step_m = 0.0;
  return config;
}

RawScan measure(const FloorPlan& plan, const LidarConfig& config, const LaserMotion& motion,
                std::uint64_t seed = 1) {
  Rng rng(seed);
  return measure_sweep(World(plan, {}), config, motion, 0.0, rng);
}

TEST(Lidar, DefaultsAreTheUtm30lx) {
  const RawScan scan = measure(kRoom, {}, stands_at({}));
  EXPECT_EQ(scan.ranges_m.size(), 1081U);
  EXPECT_FLOAT_EQ(scan.angle_min_rad, static_cast<float>(radians(-135.0)));
  EXPECT_FLOAT_EQ(scan.angle_increment_rad, static_cast<float>(radians(0.25)));
  EXPECT_FLOAT_EQ(scan.time_increment_s, 0.025F / 1440.0F);
  EXPECT_FLOAT_EQ(scan.scan_time_s, 0.025F);
  EXPECT_TRUE(check_config(LidarConfig{}));
}

TEST(Lidar, SeesTheRoomExactlyWithoutNoise) {
  const Pose2 pose{1.2, -0.7, 0.4};
  const auto scan = Scan::make(measure(kRoom, without_noise(), stands_at(pose))).value();
  EXPECT_EQ(scan.hit_count(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector2d at = pose * scan.point(i);
    const double off = std::min(std::abs(std::abs(at.x()) - 5.0), std::abs(std::abs(at.y()) - 4.0));
    EXPECT_LT(off, 2e-6) << "single precision of 7 m is 0.5e-6";
  }
}

TEST(Lidar, NoiseHasTheSigmaAndNoBias) {
  LidarConfig config;
  config.range_sigma_m = 0.02;
  const RawScan exact = measure(kRoom, without_noise(), stands_at({}));
  Rng rng(7);
  const World world(kRoom, {});
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int sweep = 0; sweep < 50; ++sweep) {
    const RawScan scan = measure_sweep(world, config, stands_at({}), 0.0, rng);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double error = static_cast<double>(scan.ranges_m[i]) - static_cast<double>(exact.ranges_m[i]);
      sum += error;
      squares += error * error;
      count += 1.0;
    }
  }
  // Rounding to a step adds step²/12 to the variance. Four standard errors of mean and of sd.
  const double sigma = std::sqrt(0.02 * 0.02 + 0.001 * 0.001 / 12.0);
  EXPECT_NEAR(sum / count, 0.0, 4.0 * sigma / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), sigma, 4.0 * sigma / std::sqrt(2.0 * count));
}

TEST(Lidar, RangesAreWholeSteps) {
  LidarConfig config;
  config.range_step_m = 0.01;
  for (const float range : measure(kRoom, config, stands_at({})).ranges_m)
    EXPECT_NEAR(std::remainder(static_cast<double>(range), 0.01), 0.0, 1e-6);
}

TEST(Lidar, NothingWithinRangeIsInfiniteAndTooNearIsMinusInfinite) {
  LidarConfig config = without_noise();
  for (const float range : measure({}, config, stands_at({})).ranges_m) EXPECT_EQ(range, kInfinity);
  config.range_max_m = 4.5;
  const auto far = Scan::make(measure(kRoom, config, stands_at({}))).value();
  EXPECT_EQ(far.beams()[540], Beam::no_return);  // 5 m ahead
  EXPECT_EQ(far.beams()[180], Beam::hit);        // 4 m to the right
  const auto near = Scan::make(measure(kRoom, config, stands_at({4.95, 0.0, 0.0}))).value();
  EXPECT_EQ(near.beams()[540], Beam::too_close);
}

TEST(Lidar, SameSeedSameBits) {
  LidarConfig config;
  config.dropout_share = 0.1;
  config.mixed_pixel_share = 0.5;
  EXPECT_EQ(measure(kRoom, config, stands_at({}), 3), measure(kRoom, config, stands_at({}), 3));
  EXPECT_NE(measure(kRoom, config, stands_at({}), 3), measure(kRoom, config, stands_at({}), 4));
}

TEST(Lidar, DropoutsHaveTheirShareAndLeaveOtherBeamsAlone) {
  LidarConfig config;
  const RawScan whole = measure(kRoom, config, stands_at({}));
  config.dropout_share = 0.2;
  const RawScan holed = measure(kRoom, config, stands_at({}));
  double dropped = 0.0;
  for (std::size_t i = 0; i < whole.ranges_m.size(); ++i) {
    if (holed.ranges_m[i] == kInfinity)
      dropped += 1.0;
    else
      EXPECT_EQ(holed.ranges_m[i], whole.ranges_m[i]);
  }
  const auto count = static_cast<double>(whole.ranges_m.size());
  EXPECT_NEAR(dropped / count, 0.2, 4.0 * std::sqrt(0.2 * 0.8 / count));
}

TEST(Lidar, MixedPixelsHangBetweenTheDepthsOfAnEdgeAndNowhereElse) {
  const FloorPlan screen_before_wall{{{{2.0, -0.5}, {2.0, 0.5}}, {{6.0, -90.0}, {6.0, 90.0}}}};
  LidarConfig config = without_noise();
  const RawScan clean = measure(screen_before_wall, config, stands_at({}));
  config.mixed_pixel_share = 1.0;
  const RawScan mixed = measure(screen_before_wall, config, stands_at({}));
  int hanging = 0;
  for (std::size_t i = 0; i < clean.ranges_m.size(); ++i) {
    if (mixed.ranges_m[i] == clean.ranges_m[i]) continue;
    ++hanging;
    EXPECT_NEAR(std::abs(-135.0 + 0.25 * static_cast<double>(i)), degrees(std::atan(0.25)), 0.25);
    EXPECT_GT(mixed.ranges_m[i], 2.0F);
    EXPECT_LT(mixed.ranges_m[i], 6.3F);
  }
  EXPECT_EQ(hanging, 2);
}

TEST(Lidar, DrivingBendsTheRoomByTheSweepTime) {
  // Source: 270 deg of a 25 ms turn are 18.75 ms. The first and the last beam look at the wall behind, 135
  // deg to either side; in between the laser has left it by 18.75 mm per m/s.
  const LaserMotion drives = [](double time_s) { return Pose2{2.0 * time_s, 0.0, 0.0}; };
  LidarConfig config = without_noise();
  const FloorPlan behind{{{{-5.0, -90.0}, {-5.0, 90.0}}}};
  const auto wall = Scan::make(measure(behind, config, drives)).value();
  EXPECT_NEAR(wall.point(0).x() - wall.point(1080).x(), 2.0 * 0.01875, 4e-6);
  config.sweep = Sweep::instantaneous;
  const auto straight = Scan::make(measure(behind, config, drives)).value();
  EXPECT_NEAR(straight.point(0).x() - straight.point(1080).x(), 0.0, 4e-6);
  EXPECT_EQ(straight.beam_time_s(1080), 0.0);
  EXPECT_NEAR(wall.beam_time_s(1080), 0.01875, 1e-8);
}

TEST(Lidar, TurningShiftsTheBearingsByTheSweepTime) {
  // At 1 rad/s the last beam looks 18.75 mrad (1.074 deg) further than its bearing says.
  const LaserMotion turns = [](double time_s) { return Pose2{0.0, 0.0, time_s}; };
  const FloorPlan behind{{{{-5.0, -90.0}, {-5.0, 90.0}}}};
  const RawScan scan = measure(behind, without_noise(), turns);
  EXPECT_NEAR(static_cast<double>(scan.ranges_m[1080]), -5.0 / std::cos(radians(135.0) + 0.01875), 1e-5);
}

}  // namespace
}  // namespace beaconless::sim
