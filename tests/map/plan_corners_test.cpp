// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/plan_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// A corner as it was drawn, in degrees.
struct Expected {
  double x_m, y_m, orientation_deg, opening_deg, arm_m;
};

double turn_deg(double a_rad, double b_rad) { return std::abs(degrees(wrap_angle(a_rad - b_rad))); }

void expect_corners(const FloorPlan& plan, const std::vector<Expected>& expected,
                    const PlanCornersConfig& config = {}) {
  const auto corners = find_plan_corners(plan, config);
  EXPECT_EQ(corners.size(), expected.size());
  for (const Expected& e : expected) {
    const auto is_it = [&](const PlanCorner& corner) {
      return (corner.point - Eigen::Vector2d(e.x_m, e.y_m)).norm() < 1e-9 &&
             turn_deg(corner.orientation_rad, radians(e.orientation_deg)) < 1e-6 &&
             std::abs(degrees(corner.opening_rad) - e.opening_deg) < 1e-6 &&
             std::abs(corner.arm_m - e.arm_m) < 1e-9;
    };
    EXPECT_EQ(std::count_if(corners.begin(), corners.end(), is_it), 1)
        << e.x_m << " " << e.y_m << " " << e.orientation_deg;
  }
}

TEST(PlanCorners, FourWallsHaveFour) {
  expect_corners(test::rectangle(3.6, 2.8), {{0.0, 0.0, 45.0, 90.0, 2.8},
                                             {3.6, 0.0, 135.0, 90.0, 2.8},
                                             {3.6, 2.8, -135.0, 90.0, 2.8},
                                             {0.0, 2.8, -45.0, 90.0, 2.8}});
}

TEST(PlanCorners, WallsDrawnOneByOneAreTheSameRoom) {
  const FloorPlan walls{{{{0, 0}, {3, 0}}, {{3, 2}, {3, 0}}, {{3, 2}, {0, 2}}, {{0, 0}, {0, 2}}}};
  EXPECT_EQ(find_plan_corners(walls).size(), find_plan_corners(test::rectangle(3.0, 2.0)).size());
  expect_corners(walls, {{0, 0, 45, 90, 2}, {3, 0, 135, 90, 2}, {3, 2, -135, 90, 2}, {0, 2, -45, 90, 2}});
}

TEST(PlanCorners, AWallThatEndsOnAnotherMakesOneOnEachSide) {
  // The long wall goes on straight on its other side, and up to the junction on this one.
  expect_corners({{{{0, 0}, {5, 0}}, {{2, 0}, {2, 1.5}}}}, {{2, 0, 45, 90, 1.5}, {2, 0, 135, 90, 1.5}});
  expect_corners({{{{0, 0}, {5, 0}}, {{2, 0}, {3, 1}}}},
                 {{2, 0, 22.5, 45, std::sqrt(2.0)}, {2, 0, 112.5, 135, std::sqrt(2.0)}});
}

TEST(PlanCorners, AClosetOnAWall) {
  const FloorPlan plan{{{{0, 0}, {9, 0}}, {{3, 0}, {3, 0.6}, {5, 0.6}, {5, 0}}}};
  expect_corners(plan, {{3, 0, 135, 90, 0.6},
                        {3, 0, 45, 90, 0.6},
                        {5, 0, 135, 90, 0.6},
                        {5, 0, 45, 90, 0.6},
                        {3, 0.6, -45, 90, 0.6},
                        {5, 0.6, -135, 90, 0.6}});
}

TEST(PlanCorners, ACrossingHasFour) {
  expect_corners({{{{-1, 0}, {2, 0}}, {{0, -3}, {0, 4}}}},
                 {{0, 0, 45, 90, 2}, {0, 0, 135, 90, 1}, {0, 0, -45, 90, 2}, {0, 0, -135, 90, 1}});
}

TEST(PlanCorners, AJunctionIsSeenFromItsWideSideToo) {
  // From the gap of 270 degrees the two outer walls look like the edge of a box.
  const double s = std::sqrt(0.5);
  expect_corners({{{{0, 0}, {1, 0}}, {{0, 0}, {s, s}}, {{0, 0}, {0, 1}}}},
                 {{0, 0, 22.5, 45, 1}, {0, 0, 67.5, 45, 1}, {0, 0, 45, 90, 1}});
}

TEST(PlanCorners, StraightWallsAndFreeEndsHaveNone) {
  EXPECT_TRUE(find_plan_corners({{{{0, 0}, {1, 0}, {2, 0}, {5, 0}}}}).empty());
  EXPECT_TRUE(find_plan_corners({{{{0, 0}, {2, 0}}, {{1, 0}, {4, 0}}}}).empty());  // overlapping
  EXPECT_TRUE(find_plan_corners({{{{0, 0}, {2, 0}, {0, 0}}}}).empty());            // there and back
  EXPECT_TRUE(find_plan_corners({{{{0, 0}, {4, 0}, {8, 0.1}}}}).empty());          // hardly bent
}

TEST(PlanCorners, ACollinearVertexDoesNotShortenAnArm) {
  expect_corners({{{{0, 3}, {0, 0}, {1, 0}, {2, 0}}}}, {{0, 0, 45, 90, 2}});
  // Nor does a wall that joins from the other side …
  expect_corners({{{{0, 0}, {7, 0}}, {{2, 0}, {2, 6}}, {{3, 0}, {3, -6}}}},
                 {{2, 0, 45, 90, 5}, {2, 0, 135, 90, 2}, {3, 0, -45, 90, 4}, {3, 0, -135, 90, 3}});
  // … and of a corner that is seen from both sides, the longer arm counts.
  const auto corners = find_plan_corners({{{{0, 3}, {0, 0}, {2, 0}}, {{1, 0}, {1, -1}}}});
  ASSERT_EQ(corners.size(), 3U);
  EXPECT_DOUBLE_EQ(corners[0].arm_m, 2.0);
  EXPECT_DOUBLE_EQ(corners[1].arm_m, 1.0);
  EXPECT_DOUBLE_EQ(corners[2].arm_m, 1.0);
}

TEST(PlanCorners, WhatIsDrawnTwiceCountsOnce) {
  FloorPlan plan = test::niche_room();
  const auto once = find_plan_corners(plan);
  const FloorPlan copy = plan;
  for (FloorPlan::Polyline wall : copy.walls) {
    std::reverse(wall.begin(), wall.end());
    plan.walls.push_back(wall);
  }
  plan.walls.push_back({{1, 0}, {3, 0}});  // a part of a wall
  const auto twice = find_plan_corners(plan);
  ASSERT_EQ(twice.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(twice[i].point, once[i].point);
    EXPECT_DOUBLE_EQ(twice[i].orientation_rad, once[i].orientation_rad);
    EXPECT_DOUBLE_EQ(twice[i].arm_m, once[i].arm_m);
  }
}

TEST(PlanCorners, EndsThatAreNearMeetAndOthersDoNot) {
  const auto corners_with_gap = [](double gap_m) {
    return find_plan_corners({{{{gap_m, 0}, {3, 0}}, {{0, 0}, {0, 3}}}}, {.join_m = 0.01}).size();
  };
  EXPECT_EQ(corners_with_gap(0.0), 1U);
  EXPECT_EQ(corners_with_gap(0.008), 1U);
  EXPECT_EQ(corners_with_gap(0.012), 0U);
  // A wall that ends just before another, or just beyond it, ends on it.
  for (const double end : {0.008, -0.008}) {
    const auto corners = find_plan_corners({{{{1, end}, {1, 2}}, {{-3, 0}, {3, 0}}}});
    ASSERT_EQ(corners.size(), 2U);
    for (const PlanCorner& corner : corners) {
      EXPECT_NEAR(corner.point.y(), 0.0, 0.01);
      EXPECT_NEAR(degrees(corner.opening_rad), 90.0, 1e-9);
    }
  }
  // Obliquely, it crosses further from its end than that; it still only ends there.
  EXPECT_EQ(find_plan_corners({{{{-3, 0}, {3, 0}}, {{2, 0.5}, {-0.03, -0.008}}}}, {.join_m = 0.01}).size(),
            2U);
}

TEST(PlanCorners, SharpAndFlatOnesGoByTheAngleBetweenTheLines) {
  const auto corners_of = [](double opening_deg) {
    const double a = radians(opening_deg);
    return find_plan_corners({{{{2, 0}, {0, 0}, {2 * std::cos(a), 2 * std::sin(a)}}}},
                             {.min_angle_deg = 25.0})
        .size();
  };
  EXPECT_EQ(corners_of(24.0), 0U);
  EXPECT_EQ(corners_of(26.0), 1U);
  EXPECT_EQ(corners_of(154.0), 1U);
  EXPECT_EQ(corners_of(156.0), 0U);
}

TEST(PlanCorners, TurnAndMoveWithThePlan) {
  FloorPlan plan = test::niche_room();
  plan.walls.push_back({{0.0, 2.0}, {1.0, 2.0}, {1.0, 3.0}, {0.0, 3.0}});  // a closet
  plan.walls.push_back({{-1.0, 4.0}, {4.0, 4.6}});                         // through the outer wall
  const auto corners = find_plan_corners(plan);
  const Pose2 moved_from_plan{-31.7, 12.3, 2.1};
  FloorPlan moved = plan;
  for (FloorPlan::Polyline& wall : moved.walls)
    for (Eigen::Vector2d& point : wall) point = moved_from_plan * point;
  const auto moved_corners = find_plan_corners(moved);
  ASSERT_EQ(moved_corners.size(), corners.size());
  for (const PlanCorner& corner : corners) {
    const Eigen::Vector2d point = moved_from_plan * corner.point;
    const double orientation = corner.orientation_rad + moved_from_plan.theta_rad;
    EXPECT_EQ(std::count_if(moved_corners.begin(), moved_corners.end(),
                            [&](const PlanCorner& other) {
                              return (other.point - point).norm() < 1e-9 &&
                                     turn_deg(other.orientation_rad, orientation) < 1e-6 &&
                                     std::abs(other.opening_rad - corner.opening_rad) < 1e-9 &&
                                     std::abs(other.arm_m - corner.arm_m) < 1e-9;
                            }),
              1);
  }
}

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

TEST(PlanCorners, AmongWallsAtRandomEveryCrossingHasFour) {
  // The slow twin: every pair of walls. Lengths and places vary so much that all sizes of cells are met.
  Rng rng(11);
  for (int round = 0; round < 20; ++round) {
    FloorPlan plan;
    for (int i = 0; i < 150; ++i) {
      const Eigen::Vector2d a(rng.uniform(-20, 20), rng.uniform(-20, 20));
      const double length = std::exp(rng.uniform(-1.0, 3.0));
      const double angle = rng.uniform(-kPi, kPi);
      plan.walls.push_back({a, a + length * Eigen::Vector2d(std::cos(angle), std::sin(angle))});
    }
    std::vector<Eigen::Vector2d> crossings;
    for (std::size_t i = 0; i < plan.walls.size(); ++i)
      for (std::size_t j = i + 1; j < plan.walls.size(); ++j) {
        const Eigen::Vector2d p = plan.walls[i][1] - plan.walls[i][0];
        const Eigen::Vector2d q = plan.walls[j][1] - plan.walls[j][0];
        const Eigen::Vector2d between = plan.walls[j][0] - plan.walls[i][0];
        const double s = cross(between, q) / cross(p, q);
        const double t = cross(between, p) / cross(p, q);
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) crossings.emplace_back(plan.walls[i][0] + s * p);
      }
    const auto corners = find_plan_corners(plan, {.min_angle_deg = 0.1, .join_m = 1e-7});
    ASSERT_GT(crossings.size(), 50U);
    for (const Eigen::Vector2d& crossing : crossings)
      EXPECT_EQ(std::count_if(corners.begin(), corners.end(),
                              [&](const PlanCorner& c) { return (c.point - crossing).norm() < 1e-6; }),
                4);
    EXPECT_EQ(corners.size(), 4 * crossings.size());
  }
}

TEST(PlanCorners, OfAHundredThousandWallsAndOneFarAway) {
  FloorPlan plan;
  for (int x = 0; x < 160; ++x)
    for (int y = 0; y < 160; ++y)
      plan.walls.push_back({{2.0 * x, 2.0 * y},
                            {2.0 * x + 1, 2.0 * y},
                            {2.0 * x + 1, 2.0 * y + 1},
                            {2.0 * x, 2.0 * y + 1},
                            {2.0 * x, 2.0 * y}});
  plan.walls.push_back({{9e7, 0}, {9e7, 1}});
  EXPECT_EQ(find_plan_corners(plan).size(), 4U * 160U * 160U);
}

TEST(PlanCorners, WallsThatAreNoneAreLeftOut) {
  EXPECT_TRUE(find_plan_corners({}).empty());
  EXPECT_TRUE(find_plan_corners({{{{0, 0}}, {}, {{1, 1}, {1, 1}}}}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  FloorPlan plan = test::rectangle(4.0, 3.0);
  plan.walls.push_back({{nan, 0}, {1, 1}});
  plan.walls.push_back({{1, 1}, {infinity, 1}});
  plan.walls.push_back({{1e300, 0}, {1e300, 1e300}});
  EXPECT_EQ(find_plan_corners(plan).size(), 4U);
}

TEST(PlanCorners, JoinedFarAndWideTheyStillEnd) {
  // Everything within a metre is one place: nonsense in, but an answer out, and finite.
  Rng rng(3);
  FloorPlan plan;
  for (int i = 0; i < 300; ++i)
    plan.walls.push_back({{rng.uniform(0, 5), rng.uniform(0, 5)}, {rng.uniform(0, 5), rng.uniform(0, 5)}});
  for (const PlanCorner& corner : find_plan_corners(plan, {.min_angle_deg = 1.0, .join_m = 1.0})) {
    EXPECT_TRUE(corner.point.allFinite());
    EXPECT_TRUE(std::isfinite(corner.arm_m));
    EXPECT_GT(corner.opening_rad, 0.0);
    EXPECT_LT(corner.opening_rad, kPi);
  }
}

}  // namespace
}  // namespace beaconless
