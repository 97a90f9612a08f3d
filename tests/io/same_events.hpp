// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"

#include "recording_samples.hpp"

namespace beaconless {

/// The same place, and a heading that passed through a quaternion a few times: each time a few roundings.
inline void expect_near(const Pose2& a, const Pose2& b) {
  constexpr double kRounding = 1e-14;
  EXPECT_EQ(a.x_m, b.x_m);
  EXPECT_EQ(a.y_m, b.y_m);
  EXPECT_NEAR(wrap_angle(a.theta_rad - b.theta_rad), 0.0, kRounding);
}

/// How far two recordings of a drive may differ in words.
struct SameEvents {
  bool sources = true;  ///< keywords of a log become topics
  bool frames = true;   ///< of scans: a name is given to one that has none
};

/// All events in their order: scans, stamps and positions as the same bits.
inline void expect_same(const Event& a, const Event& b, SameEvents same) {
  ASSERT_EQ(a.index(), b.index());
  ASSERT_EQ(stamp_of(a), stamp_of(b));
  if (const auto* scan = std::get_if<Scan>(&a)) {
    const Scan& other = std::get<Scan>(b);
    if (same.frames) {
      ASSERT_EQ(*scan, other);
    }
    ASSERT_TRUE(std::ranges::equal(scan->ranges_m(), other.ranges_m()));
    ASSERT_TRUE(std::ranges::equal(scan->beams(), other.beams()));
    ASSERT_TRUE(std::ranges::equal(scan->intensities(), other.intensities()));
    ASSERT_EQ(scan->angle_min_rad(), other.angle_min_rad());
    ASSERT_EQ(scan->angle_increment_rad(), other.angle_increment_rad());
  } else if (const auto* odometry = std::get_if<Odometry>(&a)) {
    const auto& other = std::get<Odometry>(b);
    expect_near(odometry->odom_from_base, other.odom_from_base);
    ASSERT_EQ(odometry->twist_per_s, other.twist_per_s);
    if (same.sources) {
      ASSERT_EQ(odometry->source, other.source);
    }
  } else {
    const auto& pose = std::get<ReferencePose>(a);
    const auto& other = std::get<ReferencePose>(b);
    expect_near(pose.map_from_base, other.map_from_base);
    if (same.sources) {
      ASSERT_EQ(pose.source, other.source);
    }
  }
}

/// All of two ranges of events.
template <class First, class Second>
void expect_same_events(const First& first, const Second& second, SameEvents same = {}) {
  auto other = second.begin();
  std::size_t at = 0;
  for (const Event& event : first) {
    ASSERT_NE(other, second.end()) << at;
    ASSERT_NO_FATAL_FAILURE(expect_same(event, *other, same)) << at;
    ++other;
    ++at;
  }
  EXPECT_EQ(other, second.end());
}

}  // namespace beaconless
