// SPDX-License-Identifier: Apache-2.0
#include "beaconless/scan/deskew.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Three quarters of a turn at 8 Hz; no two ranges are the same, and some beams bring none.
RawScan slow_sweep(std::size_t count) {
  RawScan raw{.stamp = Stamp{1'400'000'000'000'000'000},
              .angle_min_rad = static_cast<float>(radians(-135.0)),
              .angle_increment_rad =
                  static_cast<float>(radians(270.0) / static_cast<double>(std::max<std::size_t>(count, 2))),
              .time_increment_s = 0.094F / static_cast<float>(count),
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  for (std::size_t i = 0; i < count; ++i)
    raw.ranges_m.push_back(i % 7 == 3   ? kInf
                           : i % 7 == 5 ? kNan
                                        : 1.0F + 20.0F * static_cast<float>(i) / static_cast<float>(count));
  return raw;
}

RawScan clockwise(RawScan raw) {
  raw.angle_min_rad = -raw.angle_min_rad;
  raw.angle_increment_rad = -raw.angle_increment_rad;
  return raw;
}

Scan made(const RawScan& raw, const ScanGate& gate = {}) { return Scan::make(raw, gate).value(); }

std::vector<Eigen::Vector2d> seen(const Scan& scan, const Twist2& twist) {
  std::vector<Eigen::Vector2d> points(3, Eigen::Vector2d(99, 99));  // what was there goes
  points_at_stamp(scan, twist, points);
  return points;
}

std::vector<Eigen::Vector2d> plain(const Scan& scan) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam)) points.push_back(scan.point(beam));
  return points;
}

const Twist2 kTwists[] = {{1.5, 0.0, 1.5},  {-0.7, 0.2, -4.0}, {0.0, 0.0, 2.0},  {1.0, -1.0, 0.0},
                          {0.3, 0.1, 1e-7}, {0.0, 1e-9, 0.0},  {20.0, 3.0, 30.0}};

void expect_each_beam_where_it_was(const Scan& scan) {
  for (const Twist2& twist : kTwists) {
    const auto points = seen(scan, twist);
    ASSERT_EQ(points.size(), scan.hit_count()) << "what is no hit is left out";
    std::size_t next = 0;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (!scan.is_hit(beam)) continue;
      const Eigen::Vector2d expected = Pose2::exp(scan.beam_time_s(beam) * twist) * scan.point(beam);
      ASSERT_LT((points[next++] - expected).norm(), 1e-9) << "beam " << beam << " at " << twist.vector().z();
    }
  }
}

TEST(Deskew, EachBeamIsSeenFromWhereTheLaserWasThen) {
  for (const std::size_t count : {2U, 40U, 1081U, 100'000U})
    expect_each_beam_where_it_was(made(slow_sweep(count)));
}

TEST(Deskew, BeamTimesOfAClockwiseScannerRunBackwards) {
  const Scan scan = made(clockwise(slow_sweep(1081)));
  ASSERT_GT(scan.beam_time_s(0), scan.beam_time_s(1080));
  ASSERT_EQ(scan.beam_time_s(1080), 0.0);
  expect_each_beam_where_it_was(scan);
  // The beam that was measured first stays where it was, at whichever end of the scan it is.
  EXPECT_LT((seen(scan, kTwists[0]).back() - plain(scan).back()).norm(), 1e-12);
}

TEST(Deskew, WhicheverBeamTheStampMeansPointsAreThoseAtTheFirst) {
  for (const StampIs stamp_is : {StampIs::middle_beam, StampIs::last_beam})
    EXPECT_EQ(seen(made(slow_sweep(500), {.stamp_is = stamp_is}), kTwists[0]),
              seen(made(slow_sweep(500)), kTwists[0]));
}

TEST(Deskew, WithoutBeamTimesPointsStayAsTheyAre) {
  RawScan raw = slow_sweep(1081);
  raw.time_increment_s = 0.0F;
  EXPECT_EQ(seen(made(raw), kTwists[0]), plain(made(raw)));
}

TEST(Deskew, OfARobotThatStandsPointsStayAsTheyAre) {
  const Scan scan = made(slow_sweep(1081));
  EXPECT_EQ(seen(scan, Twist2{}), plain(scan));
}

TEST(Deskew, OneBeamOrNoHitIsNoTrouble) {
  const Scan single = made(slow_sweep(1));
  EXPECT_EQ(seen(single, kTwists[0]), plain(single));
  RawScan blind = slow_sweep(50);
  blind.ranges_m.assign(50, kInf);
  EXPECT_TRUE(seen(made(blind), kTwists[0]).empty());
}

/// What it is for: a wall that a turning laser sweeps over is straight again.
TEST(Deskew, AWallSweptByAMovingLaserIsStraight) {
  const Twist2 twist{1.5, 0.0, 1.5};
  RawScan raw{.angle_min_rad = static_cast<float>(radians(-60.0)),
              .angle_increment_rad = static_cast<float>(radians(0.25)),
              .time_increment_s = 1e-4F,
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  for (int i = 0; i < 481; ++i) {  // the wall x = 5 m in the frame of the laser at the stamp
    const Pose2 laser = Pose2::exp(i * static_cast<double>(raw.time_increment_s) * twist);
    const double bearing = laser.theta_rad + static_cast<double>(raw.angle_min_rad) +
                           i * static_cast<double>(raw.angle_increment_rad);
    raw.ranges_m.push_back(static_cast<float>((5.0 - laser.x_m) / std::cos(bearing)));
  }
  const Scan scan = made(raw);
  for (const Eigen::Vector2d& point : seen(scan, twist)) ASSERT_NEAR(point.x(), 5.0, 1e-5);
  EXPECT_GT(std::abs(plain(scan).back().x() - 5.0), 0.1) << "or there would be nothing to mend";
}

}  // namespace
}  // namespace beaconless
