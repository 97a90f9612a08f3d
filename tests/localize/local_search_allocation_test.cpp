// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "beaconless/match/local_search.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

TEST(LocalSearch, AllocatesNothingOnceItsBuffersHaveGrown) {
  const FloorPlan plan = test::niche_room();
  const NearnessPyramid map{SurfaceMap(WallIndex(plan))};
  const Pose2 truth{2.0, 1.5, 0.4};
  Rng rng(1);
  const auto points =
      test::points_of(Scan::make(test::sweep(RayCaster(plan.segments()), truth, 0.01, rng)).value());
  LocalSearchScratch scratch;
  std::vector<StartPose> starts;
  search_around(points, map, truth, {}, scratch, starts);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  search_around(points, map, truth, {}, scratch, starts);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_FALSE(starts.empty());
}

}  // namespace
}  // namespace beaconless
