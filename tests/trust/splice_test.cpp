// SPDX-License-Identifier: Apache-2.0
// A robot that is carried: what its sensors tell goes on as if nothing had happened.
#include "bench/trust/splice.hpp"

#include <gtest/gtest.h>

#include "bench/trust/retimed.hpp"

namespace beaconless::trust {
namespace {

Scan scan_at(double time_s, float range_m) {
  RawScan raw{.stamp = Stamp::from_seconds(time_s),
              .angle_min_rad = -1.0F,
              .angle_increment_rad = 0.5F,
              .time_increment_s = 0.001F,
              .range_max_m = 30.0F};
  raw.ranges_m.assign(5, range_m);
  return Scan::make(std::move(raw)).value();
}

/// Ten scans at 10 Hz while the robot drives a metre along x, wheels between them.
Trial drive() {
  Trial trial{.kind = "test", .family = "line"};
  for (int i = 0; i < 10; ++i) {
    const double time_s = 100.0 + 0.1 * i;
    trial.events.emplace_back(scan_at(time_s, 1.0F + static_cast<float>(i)));
    trial.events.emplace_back(
        Odometry{.stamp = Stamp::from_seconds(time_s + 0.05), .odom_from_base = {0.1 * i, 0.0, 0.0}});
    trial.truth.push_back({0.1 * i, 2.0, 0.0});
  }
  return trial;
}

std::vector<double> scan_times_s(const Trial& trial) {
  std::vector<double> times;
  for (const Event& event : trial.events)
    if (const auto* scan = std::get_if<Scan>(&event)) times.push_back(scan->stamp().seconds());
  return times;
}

TEST(Splice, HasTheScansAndTheTruthOfBothParts) {
  const Trial trial = drive();
  const Trial spliced = splice({&trial, 6, 9}, {&trial, 1, 3});
  ASSERT_EQ(spliced.truth.size(), 5U);
  EXPECT_DOUBLE_EQ(spliced.truth[2].x_m, 0.8);
  EXPECT_DOUBLE_EQ(spliced.truth[3].x_m, 0.1);
  EXPECT_FLOAT_EQ(scan_of(spliced, 2).ranges_m()[0], 9.0F);
  EXPECT_FLOAT_EQ(scan_of(spliced, 3).ranges_m()[0], 2.0F);
  EXPECT_EQ(spliced.starts.front().map_from_base, spliced.truth.front());
}

TEST(Splice, GoesOnEvenly) {
  const Trial trial = drive();
  const std::vector<double> times = scan_times_s(splice({&trial, 6, 9}, {&trial, 1, 3}));
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_NEAR(times[i] - times[i - 1], 0.1, 1e-6) << i;
}

TEST(Splice, OdometryDoesNotTellTheCarry) {
  const Trial trial = drive();
  const Trial spliced = splice({&trial, 6, 9}, {&trial, 1, 3});
  std::optional<Pose2> last;
  for (const Event& event : spliced.events)
    if (const auto* odometry = std::get_if<Odometry>(&event)) {
      if (last) {
        EXPECT_LT(distance_m(*last, odometry->odom_from_base), 0.15);
      }
      last = odometry->odom_from_base;
    }
  EXPECT_TRUE(last.has_value());
}

TEST(Splice, EventsAreInOrderOfTime) {
  const Trial trial = drive();
  const Trial spliced = splice({&trial, 0, 4}, {&trial, 5, 10});
  for (std::size_t i = 1; i < spliced.events.size(); ++i)
    EXPECT_LE(stamp_of(spliced.events[i - 1]), stamp_of(spliced.events[i])) << i;
}

TEST(Retimed, ChangesTheStampAlone) {
  RawScan raw{.stamp = Stamp::from_seconds(5.0),
              .angle_min_rad = 1.0F,
              .angle_increment_rad = -0.5F,
              .time_increment_s = 0.001F,
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  raw.ranges_m = {1.0F, 0.01F, std::numeric_limits<float>::infinity(), 40.0F, 2.0F};
  const Scan scan = Scan::make(raw).value();
  const Scan later = retimed(scan, Stamp::from_seconds(9.0));
  EXPECT_EQ(later.stamp(), Stamp::from_seconds(9.0));
  EXPECT_EQ(retimed(later, scan.stamp()), scan);
}

}  // namespace
}  // namespace beaconless::trust
