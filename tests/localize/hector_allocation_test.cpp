// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "beaconless/match/hector.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

TEST(Hector, AllocatesNothingOnceItsBuffersHaveGrown) {
  Rng rng(3);
  // A room, and a corridor, where directions are put back.
  for (const FloorPlan& plan :
       {test::niche_room(), FloorPlan{{{{-100, 0}, {100, 0}}, {{-100, 4}, {100, 4}}}}}) {
    const RayCaster walls(plan.segments());
    const OccupancyPyramid pyramid = build_pyramid(plan).value();
    const Pose2 pose{3.0, 2.0, 0.3};
    const auto points = test::points_of(Scan::make(test::sweep(walls, pose, 0.01, rng)).value());
    HectorScratch scratch;
    match_hector(points, pyramid, pose, {}, scratch);
    const std::size_t before = test::allocations();
    ASSERT_GT(before, 0U) << "the counter does not count";
    const MatchResult match = match_hector(points, pyramid, pose, {}, scratch);
    const std::span<const Eigen::Vector2d> fewer(points.data(), points.size() / 2);
    match_hector(fewer, pyramid, pose, {}, scratch);
    EXPECT_EQ(test::allocations(), before);
    EXPECT_TRUE(match.usable());
  }
}

}  // namespace
}  // namespace beaconless
