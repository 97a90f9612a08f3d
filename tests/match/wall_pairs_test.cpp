// SPDX-License-Identifier: Apache-2.0
// Which wall each beam is paired with, and how it is written down.
#include "beaconless/match/wall_pairs.hpp"

#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

struct Seen {
  WallIndex index{test::niche_room()};
  std::vector<Eigen::Vector2d> points;
  Pose2 pose;
};

Seen seen_from(const Pose2& pose, Rng& rng) {
  Seen seen{.pose = pose};
  const RayCaster caster(test::niche_room().segments());
  seen.points = test::points_of(Scan::make(test::sweep(caster, pose, 0.01, rng)).value());
  return seen;
}

TEST(WallPairs, EveryLoopPairsTheSame) {
  if (fastest_vector_loop() == VectorLoop::portable)
    GTEST_SKIP() << "this processor knows the portable loop only";
  Rng rng(6);
  for (int run = 0; run < 40; ++run) {
    Seen seen = seen_from({rng.uniform(0.8, 5.0), rng.uniform(0.8, 3.0), rng.uniform(-kPi, kPi)}, rng);
    seen.points.resize(seen.points.size() - static_cast<std::size_t>(run % 5));  // a rest of 0 to 3 beams
    WallsConfig config;
    if (run % 2 == 1) config.footprint_rad = 0.002;
    WallBeams fast;
    WallBeams portable;
    const WallPairing one =
        pair_with_walls(seen.points, seen.index, seen.pose, 0.1, config, fast, VectorLoop::avx2);
    const WallPairing other =
        pair_with_walls(seen.points, seen.index, seen.pose, 0.1, config, portable, VectorLoop::portable);
    ASSERT_EQ(fast.count, portable.count);
    EXPECT_NEAR(one.on_map_ratio, other.on_map_ratio, 1e-12);
    EXPECT_NEAR(one.misfit, other.misfit, 1e-12);
    for (std::size_t i = 0; i < fast.count; ++i) {
      ASSERT_EQ(fast.x_m[i], portable.x_m[i]);
      ASSERT_NEAR(fast.ux[i], portable.ux[i], 1e-12);
      ASSERT_NEAR(fast.uy[i], portable.uy[i], 1e-12);
      ASSERT_NEAR(fast.nx[i], portable.nx[i], 1e-12);
      ASSERT_NEAR(fast.ny[i], portable.ny[i], 1e-12);
      ASSERT_NEAR(fast.offset_m[i], portable.offset_m[i], 1e-12);
      ASSERT_NEAR(fast.information[i] / portable.information[i], 1.0, 1e-9);
    }
  }
}

/// From the true pose every beam ends on its wall but for noise, and every wall looks away from the laser.
TEST(WallPairs, NormalsLookAwayAndBeamsEndOnTheirWalls) {
  Rng rng(7);
  for (int run = 0; run < 20; ++run) {
    const Seen seen = seen_from({rng.uniform(0.8, 5.0), rng.uniform(0.8, 3.0), rng.uniform(-kPi, kPi)}, rng);
    WallBeams beams;
    const WallPairing pairing =
        pair_with_walls(seen.points, seen.index, seen.pose, 0.1, WallsConfig{}, beams, fastest_vector_loop());
    EXPECT_GT(pairing.on_map_ratio, 0.99);
    EXPECT_GT(static_cast<double>(beams.count), 0.98 * static_cast<double>(seen.points.size()));
    for (std::size_t i = 0; i < beams.count; ++i) {
      EXPECT_GT(beams.nx[i] * beams.ux[i] + beams.ny[i] * beams.uy[i], 0.0);
      EXPECT_GT(beams.offset_m[i], 0.0);
      const double beside = beams.nx[i] * beams.x_m[i] + beams.ny[i] * beams.y_m[i] - beams.offset_m[i];
      EXPECT_LT(std::abs(beside), 0.1);
    }
  }
}

}  // namespace
}  // namespace beaconless
