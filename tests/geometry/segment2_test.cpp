// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/segment2.hpp"

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

Eigen::Vector2d random_point(Rng& rng) { return {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)}; }

// The slow twin: walk along the segment. In between two samples the distance is at most half a step too long.
TEST(Segment2, NearestIsNearerThanEveryPointOfTheSegment) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Segment2 segment{random_point(rng), random_point(rng)};
    const Eigen::Vector2d point = random_point(rng);
    double walked = (point - segment.a).norm();
    constexpr int kSteps = 1000;
    for (int k = 0; k <= kSteps; ++k)
      walked = std::min(walked, (point - segment.a - (segment.b - segment.a) * k / kSteps).norm());
    EXPECT_LE(segment.distance_m(point), walked + 1e-14);
    EXPECT_GE(segment.distance_m(point), walked - 0.5 * segment.length_m() / kSteps);
    const Eigen::Vector2d nearest = segment.nearest(point);
    EXPECT_NEAR((nearest - segment.a).norm() + (segment.b - nearest).norm(), segment.length_m(), 1e-14)
        << "it lies on the segment";
  }
}

TEST(Segment2, BeyondAnEndTheEndIsNearest) {
  const Segment2 segment{{1.0, 1.0}, {3.0, 1.0}};
  EXPECT_EQ(segment.nearest({0.0, 5.0}), segment.a);
  EXPECT_EQ(segment.nearest({9.0, -5.0}), segment.b);
  EXPECT_EQ(segment.nearest({2.0, 5.0}), Eigen::Vector2d(2.0, 1.0));
}

TEST(Segment2, OfNoLengthIsAPoint) {
  const Segment2 segment{{1.0, 1.0}, {1.0, 1.0}};
  EXPECT_DOUBLE_EQ(segment.distance_m({4.0, 5.0}), 5.0);
  EXPECT_EQ(segment.length_m(), 0.0);
}

}  // namespace
}  // namespace beaconless
