// SPDX-License-Identifier: Apache-2.0
// Free space as evidence: beams end behind walls only where the laser is not.
#include "beaconless/match/see_through.hpp"

#include <gtest/gtest.h>

#include "beaconless/map/rasterize.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// Two rooms side by side, each 4 x 4 m, with a wall between them that has a door.
FloorPlan two_rooms() {
  return {{{{0, 0}, {8, 0}, {8, 4}, {0, 4}, {0, 0}}, {{4, 0}, {4, 2.6}}, {{4, 3.4}, {4, 4}}}};
}

struct Seen {
  std::vector<Eigen::Vector2d> points;
  SurfaceMap map;
};

Seen from(const Pose2& pose, double people_share = 0.0) {
  const FloorPlan plan = two_rooms();
  Rng rng(3);
  RawScan raw = test::sweep(RayCaster(plan.segments()), pose, 0.01, rng);
  for (float& range : raw.ranges_m)
    if (rng.uniform() < people_share) range *= 0.4F;
  return {test::points_of(Scan::make(raw).value()), build_surface_map(plan, 0.6).value()};
}

TEST(SeeThrough, IsNothingWhereTheLaserIs) {
  for (const Pose2 pose : {Pose2{2, 2, 0.3}, Pose2{3.5, 3.0, 1.0}, Pose2{6, 1, -2.0}})
    for (const double people : {0.0, 0.3, 0.6}) {
      const Seen seen = from(pose, people);
      EXPECT_LT(see_through_share(seen.points, seen.map, pose, 1), 0.01) << pose << people;
    }
}

TEST(SeeThrough, IsMuchWhereItIsNot) {
  const Seen seen = from({2, 2, 0.3});
  EXPECT_GT(see_through_share(seen.points, seen.map, {4.6, 2, 0.3}, 1), 0.1);  // ten times and more
  EXPECT_GT(see_through_share(seen.points, seen.map, {7.5, 3.5, 2.0}, 1), 0.4);
}

TEST(SeeThrough, TellsNearlyTheSameByFewBeams) {
  const Seen seen = from({2, 2, 0.3});
  const Pose2 wrong{4.6, 2, 0.3};
  const double all = see_through_share(seen.points, seen.map, wrong, 1);
  EXPECT_NEAR(see_through_share(seen.points, seen.map, wrong, 9), all, 0.05);
}

TEST(SeeThrough, OfNoPointsIsNone) {
  const Seen seen = from({2, 2, 0.3});
  EXPECT_EQ(see_through_share({}, seen.map, {2, 2, 0}, 1), 0.0);
  const std::vector<Eigen::Vector2d> at_the_laser(3, Eigen::Vector2d::Zero());
  EXPECT_EQ(see_through_share(at_the_laser, seen.map, {2, 2, 0}, 0), 0.0);
}

TEST(SeeThrough, IsAskedOfGridsToo) {
  const Seen seen = from({2, 2, 0.3});
  OccupancyGrid grid = rasterize(two_rooms(), {}).value();
  const SurfaceMap map = build_surface_map(grid, 0.6).value();
  EXPECT_LT(see_through_share(seen.points, map, {2, 2, 0.3}, 1), 0.03);
  EXPECT_GT(see_through_share(seen.points, map, {7.5, 3.5, 2.0}, 1), 0.4);
}

}  // namespace
}  // namespace beaconless
