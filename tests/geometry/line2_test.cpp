// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/line2.hpp"

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

Eigen::Vector2d random_point(Rng& rng) { return {rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)}; }

TEST(Line2, GoesThroughItsTwoPoints) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p = random_point(rng);
    const Eigen::Vector2d q = random_point(rng);
    const auto line = Line2::through(p, q);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->signed_distance_m(p), 0.0, 1e-14);
    EXPECT_NEAR(line->signed_distance_m(q), 0.0, 1e-14);
    EXPECT_GE(line->rho_m, 0.0);
    EXPECT_NEAR(line->normal().norm(), 1.0, 1e-15);
    EXPECT_NEAR(line->signed_distance_m({0.0, 0.0}), -line->rho_m, 1e-15)
        << "the origin is on the negative side";
  }
}

TEST(Line2, UprightAndLevelLinesAreNothingSpecial) {
  EXPECT_EQ(*Line2::through({2.0, 0.0}, {2.0, 1.0}), (Line2{0.0, 2.0}));
  EXPECT_NEAR(Line2::through({-2.0, 0.0}, {-2.0, 1.0})->normal().x(), -1.0, 1e-15);
  EXPECT_DOUBLE_EQ(Line2::through({0.0, 3.0}, {1.0, 3.0})->alpha_rad, kPi / 2.0);
}

TEST(Line2, NeedsTwoPoints) { EXPECT_FALSE(Line2::through({1.0, 2.0}, {1.0, 2.0})); }

TEST(Line2, IntersectionLiesOnBothLines) {
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d crossing = random_point(rng);
    const double heading = rng.uniform(-kPi, kPi);
    const double between = rng.uniform(0.01, kPi - 0.01);
    const auto line_to = [&](double angle) {
      return *Line2::through(crossing, crossing + Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    };
    const auto found = intersection(line_to(heading), line_to(heading + between));
    ASSERT_TRUE(found);
    EXPECT_LT((*found - crossing).norm(), 1e-12);  // rounding of 1e-15 * 5 m over sin(0.01)
  }
}

TEST(Line2, ParallelLinesDoNotCross) {
  EXPECT_FALSE(intersection({0.3, 1.0}, {0.3, 2.0}));
  EXPECT_FALSE(intersection({0.3, 1.0}, {0.3 - kPi, 2.0})) << "on the other side of the origin";
  EXPECT_FALSE(intersection({0.0, 1.0}, {radians(4.0), 1.0}, radians(5.0)));
  EXPECT_TRUE(intersection({0.0, 1.0}, {radians(6.0), 1.0}, radians(5.0)));
  EXPECT_FALSE(intersection({std::nan(""), 1.0}, {0.0, 1.0}));
}

}  // namespace
}  // namespace beaconless
