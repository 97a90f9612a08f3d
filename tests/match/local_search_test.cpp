// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/local_search.hpp"

#include <gtest/gtest.h>

#include "beaconless/match/icp.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

TEST(LocalSearch, OneOfItsStartsLeadsIcpHomeWhereTheGuessDoesNot) {
  const FloorPlan plan = test::niche_room();
  const RayCaster walls(plan.segments());
  const WallIndex index(plan);
  const NearnessPyramid nearness{SurfaceMap(index)};
  Rng rng(5);
  IcpScratch scratch;
  LocalSearchScratch search;
  std::vector<StartPose> starts;
  int by_guess = 0;
  int by_search = 0;
  const int runs = 40;
  for (int i = 0; i < runs; ++i) {
    const Pose2 truth{rng.uniform(1.0, 5.0), rng.uniform(1.0, 3.0), rng.uniform(-3.0, 3.0)};
    const double turn = radians(rng.uniform(20.0, 45.0)) * (rng.uniform() < 0.5 ? -1.0 : 1.0);
    const Pose2 guess{truth.x_m + rng.uniform(-0.8, 0.8), truth.y_m + rng.uniform(-0.8, 0.8),
                      truth.theta_rad + turn};
    const auto points = test::points_of(Scan::make(test::sweep(walls, truth, 0.01, rng)).value());
    const auto home = [&](const Pose2& start) {
      return distance_m(match_icp(points, index, start, {}, scratch).map_from_laser, truth) < 0.01;
    };
    by_guess += home(guess) ? 1 : 0;
    search_around(points, nearness, guess, {}, search, starts);
    ASSERT_FALSE(starts.empty());
    for (std::size_t k = 1; k < starts.size(); ++k) ASSERT_LE(starts[k - 1].cost, starts[k].cost);
    by_search +=
        std::any_of(starts.begin(), starts.end(), [&](const StartPose& s) { return home(s.map_from_laser); });
  }
  EXPECT_EQ(by_search, runs);
  EXPECT_LT(by_guess, runs);  // or the search would be for nothing
}

TEST(LocalSearch, FindsNothingInNothing) {
  const NearnessPyramid nearness{SurfaceMap(WallIndex(test::niche_room()))};
  LocalSearchScratch scratch;
  std::vector<StartPose> starts(1);
  search_around({}, nearness, {}, {}, scratch, starts);
  EXPECT_TRUE(starts.empty());
}

}  // namespace
}  // namespace beaconless
