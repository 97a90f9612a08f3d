// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/world.hpp"

#include <gtest/gtest.h>

namespace beaconless::sim {
namespace {

const FloorPlan kWall{{{{5.0, -3.0}, {5.0, 3.0}}}};

TEST(Person, WalksToTheLastWaypointAndBack) {
  const Person person{
      .radius_m = 0.2, .speed_mps = 2.0, .start_s = 1.0, .waypoints = {{0, 0}, {4, 0}, {4, 2}}};
  EXPECT_EQ(person.position_m(-5.0), Eigen::Vector2d(0, 0));
  EXPECT_EQ(person.position_m(1.0), Eigen::Vector2d(0, 0));
  EXPECT_NEAR((person.position_m(2.0) - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((person.position_m(3.5) - Eigen::Vector2d(4, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((person.position_m(4.5) - Eigen::Vector2d(4, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((person.position_m(7.0) - Eigen::Vector2d(0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((person.position_m(8.0) - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
}

TEST(Person, StandsWhereThereIsNoWay) {
  EXPECT_EQ((Person{.waypoints = {}}.position_m(9.0)), Eigen::Vector2d(0, 0));
  EXPECT_EQ((Person{.waypoints = {{1, 2}}}.position_m(9.0)), Eigen::Vector2d(1, 2));
  EXPECT_EQ((Person{.waypoints = {{1, 2}, {1, 2}}}.position_m(9.0)), Eigen::Vector2d(1, 2));
}

TEST(World, PeopleHideWalls) {
  const World world(kWall,
                    {{.radius_m = 0.25, .speed_mps = 1.0, .start_s = 0.0, .waypoints = {{2, 0}, {2, 2}}}});
  EXPECT_NEAR(*world.range_m({0, 0}, {1, 0}, 30.0, 0.0), 1.75, 1e-12);
  EXPECT_NEAR(*world.range_m({0, 0}, {1, 0}, 30.0, 1.0), 5.0, 1e-12) << "has stepped aside";
  EXPECT_NEAR(*world.range_m({0, 1}, {1, 0}, 30.0, 1.0), 1.75, 1e-12);
  // Beside the middle the disc is met later: 2 - sqrt(0.25² - 0.15²).
  EXPECT_NEAR(*world.range_m({0, 0.15}, {1, 0}, 30.0, 0.0), 1.8, 1e-12);
  EXPECT_NEAR(*world.range_m({0, 0.26}, {1, 0}, 30.0, 0.0), 5.0, 1e-12);
}

TEST(World, PeopleBehindTheLaserOrTheWallAreNotSeen) {
  const World world(kWall, {{.waypoints = {{-2, 0}}}, {.waypoints = {{7, 0}}}});
  EXPECT_NEAR(*world.range_m({0, 0}, {1, 0}, 30.0, 0.0), 5.0, 1e-12);
  EXPECT_FALSE(world.range_m({0, 0}, {1, 0}, 4.0, 0.0));
  EXPECT_FALSE(world.range_m({0, 0}, {0, 1}, 30.0, 0.0));
  EXPECT_EQ(world.range_m({-2, 0.1}, {1, 0}, 30.0, 0.0), 0.0) << "from inside a person";
}

}  // namespace
}  // namespace beaconless::sim
