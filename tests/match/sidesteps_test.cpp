// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/sidesteps.hpp"

#include <gtest/gtest.h>

#include "beaconless/match/icp.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

TEST(Sidesteps, AreAllAroundAtTheSameDistanceAndHeading) {
  const Pose2 pose{3.0, -2.0, 2.5};
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Pose2& beside : sidesteps(pose, 0.2)) {
    EXPECT_NEAR(distance_m(beside, pose), 0.2, 1e-12);
    EXPECT_NEAR(heading_difference_rad(beside, pose), 0.0, 1e-12);
    sum += beside.translation() - pose.translation();
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-12);
}

/// A room whose walls have two faces, 12 cm apart.
FloorPlan thick_room() {
  FloorPlan plan;
  plan.walls.push_back({{0, 0}, {6, 0}, {6, 4}, {2.5, 4}, {2.5, 5}, {0, 5}, {0, 0}});
  plan.walls.push_back({{-0.12, -0.12},
                        {6.12, -0.12},
                        {6.12, 4.12},
                        {2.62, 4.12},
                        {2.62, 5.12},
                        {-0.12, 5.12},
                        {-0.12, -0.12}});
  return plan;
}

TEST(Sidesteps, LeadOutOfAFitToTheFarFacesOfWalls) {
  const FloorPlan plan = thick_room();
  const SurfaceMap map{WallIndex(plan)};
  const RayCaster walls(plan.segments());
  Rng rng(8);
  const Pose2 truth{2.0, 1.5, 0.4};
  const auto points = test::points_of(Scan::make(test::sweep(walls, truth, 0.005, rng)).value());
  IcpScratch scratch;
  const MatchResult stuck = match_icp(points, map, {2.09, 1.59, 0.4}, {}, scratch);
  ASSERT_TRUE(stuck.usable());
  ASSERT_GT(distance_m(stuck.map_from_laser, truth), 0.08);  // else there is nothing to get out of
  double nearest_m = 1.0;
  for (const Pose2& beside : sidesteps(stuck.map_from_laser)) {
    const MatchResult match = match_icp(points, map, beside, {}, scratch);
    if (match.misfit < stuck.misfit - 0.05)
      nearest_m = std::min(nearest_m, distance_m(match.map_from_laser, truth));
  }
  EXPECT_LT(nearest_m, 0.01);
}

}  // namespace
}  // namespace beaconless
