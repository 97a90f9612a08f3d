// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/tape_measured.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/line2.hpp"
#include "beaconless/geometry/rigid_fit.hpp"

namespace beaconless::sim {
namespace {

using Polyline = FloorPlan::Polyline;

/// A room with a jog and a pillar, a closet against its north wall, a screen in the middle, a round bin.
FloorPlan furnished() {
  Polyline bin;
  for (int i = 0; i <= 8; ++i) {
    const double bearing = radians(45.0 * (i % 8));
    bin.emplace_back(4.0 + 0.2 * std::cos(bearing), 2.0 + 0.2 * std::sin(bearing));
  }
  return {
      {{{0, 0}, {7, 0}, {7, 0.15}, {9, 0.15}, {9, 6}, {5, 6}, {5, 5.6}, {4.6, 5.6}, {4.6, 6}, {0, 6}, {0, 0}},
       {{1, 6}, {1, 5.5}, {3, 5.5}, {3, 6}},
       {{5.5, 2.5}, {7.5, 4.0}},
       bin}};
}

Line2 line_of(const Segment2& segment) { return *Line2::through(segment.a, segment.b); }

double turn_deg(const Segment2& p, const Segment2& q) {
  const Eigen::Vector2d u = p.b - p.a;
  const Eigen::Vector2d v = q.b - q.a;
  return degrees(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)));
}

TEST(TapeMeasured, WithoutErrorsItIsThePlan) {
  const FloorPlan plan = furnished();
  const FloorPlan measured = tape_measured(plan, {.offset_sigma_m = 0.0, .turn_sigma_deg = 0.0});
  ASSERT_EQ(measured.walls.size(), plan.walls.size());
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    ASSERT_EQ(measured.walls[i].size(), plan.walls[i].size());
    for (std::size_t k = 0; k < plan.walls[i].size(); ++k)
      EXPECT_LT((measured.walls[i][k] - plan.walls[i][k]).norm(), 1e-12);
  }
}

TEST(TapeMeasured, SameSeedSameBitsOtherSeedOtherErrors) {
  EXPECT_EQ(tape_measured(furnished()), tape_measured(furnished()));
  EXPECT_NE(tape_measured(furnished()), tape_measured(furnished(), {.seed = 2}));
  EXPECT_NE(tape_measured(furnished()), furnished());
}

TEST(TapeMeasured, WhatComesLaterChangesNothingBefore) {
  FloorPlan more = furnished();
  more.walls.push_back({{2, 2}, {3, 2}, {3, 3}, {2, 3}, {2, 2}});
  const FloorPlan few = tape_measured(furnished());
  const FloorPlan many = tape_measured(more);
  for (std::size_t i = 0; i < few.walls.size(); ++i) EXPECT_EQ(few.walls[i], many.walls[i]);
}

TEST(TapeMeasured, OutlinesStayClosedAndEndsStayOnTheirWall) {
  for (int seed = 0; seed < 200; ++seed) {
    const FloorPlan measured = tape_measured(furnished(), {.seed = seed});
    EXPECT_EQ(measured.walls[0].front(), measured.walls[0].back());
    EXPECT_EQ(measured.walls[3].front(), measured.walls[3].back());
    const Segment2 north{measured.walls[0][8], measured.walls[0][9]};
    EXPECT_LT(north.distance_m(measured.walls[1].front()), 1e-12) << seed;
    EXPECT_LT(north.distance_m(measured.walls[1].back()), 1e-12) << seed;
  }
}

TEST(TapeMeasured, WallsMoveAndTurnAsFarAsTheConfigSaysEachForItself) {
  // Off the origin, so that the normals of the lines keep their side.
  const FloorPlan room{{{{10, 10}, {16, 10}, {16, 15}, {10, 15}, {10, 10}}}};
  constexpr int kTapes = 4000;
  const auto real = room.segments();
  Eigen::Matrix4d offsets = Eigen::Matrix4d::Zero();
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Vector4d turns = Eigen::Vector4d::Zero();
  for (int seed = 0; seed < kTapes; ++seed) {
    const auto measured = tape_measured(room, {.seed = seed}).segments();
    Eigen::Vector4d offset;
    for (Eigen::Index k = 0; k < 4; ++k) {
      const auto& wall = real[static_cast<std::size_t>(k)];
      const auto& moved = measured[static_cast<std::size_t>(k)];
      // The real middle's distance from the measured line, first order in the turn.
      offset[k] = line_of(moved).signed_distance_m(0.5 * (wall.a + wall.b));
      turns[k] += std::pow(turn_deg(wall, moved), 2);
    }
    mean += offset;
    offsets += offset * offset.transpose();
  }
  offsets /= kTapes;
  // A standard deviation from n draws is good to 1/√(2n) = 1.1 %; four of those.
  constexpr double kSlack = 4.0 * 0.0112;
  for (Eigen::Index k = 0; k < 4; ++k) {
    EXPECT_NEAR(mean[k] / kTapes, 0.0, 4.0 * 0.008 / std::sqrt(kTapes));
    EXPECT_NEAR(std::sqrt(offsets(k, k)) / 0.008, 1.0, kSlack) << k;
    EXPECT_NEAR(std::sqrt(turns[k] / kTapes) / 0.2, 1.0, kSlack) << k;
    for (Eigen::Index j = 0; j < k; ++j)
      EXPECT_NEAR(offsets(j, k) / (0.008 * 0.008), 0.0, 4.0 / std::sqrt(kTapes)) << j << k;
  }
}

TEST(TapeMeasured, AFreeEndMovesAlongItsWallAsFarAsWallsMoveAcross) {
  const FloorPlan screen{{{{0, 0}, {3, 0}}}};
  constexpr int kTapes = 2000;
  double first = 0.0;
  double both = 0.0;
  for (int seed = 0; seed < kTapes; ++seed) {
    const FloorPlan measured = tape_measured(screen, {.turn_sigma_deg = 0.0, .seed = seed});
    EXPECT_EQ(measured.walls[0][0].y(), measured.walls[0][1].y());
    first += std::pow(measured.walls[0][0].x(), 2);
    both += measured.walls[0][0].x() * (measured.walls[0][1].x() - 3.0);
  }
  EXPECT_NEAR(std::sqrt(first / kTapes) / 0.008, 1.0, 4.0 / std::sqrt(2.0 * kTapes));
  EXPECT_NEAR(both / kTapes / 6.4e-5, 0.0, 4.0 / std::sqrt(kTapes));
}

TEST(TapeMeasured, ASmallThingMovesAsAWhole) {
  const Polyline bin = furnished().walls[3];
  for (int seed = 0; seed < 50; ++seed) {
    const Polyline moved = tape_measured(furnished(), {.seed = seed}).walls[3];
    EXPECT_NE(moved, bin);
    for (std::size_t i = 0; i < bin.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_NEAR((moved[i] - moved[j]).norm(), (bin[i] - bin[j]).norm(), 1e-12);
  }
}

TEST(TapeMeasured, TableIsMeasuredSideBySideWhereItIsLargeEnough) {
  const FloorPlan table{{{{0, 0}, {0.6, 0}, {0.6, 0.4}, {0, 0.4}, {0, 0}}}};
  const auto width = [](const FloorPlan& plan) { return (plan.walls[0][1] - plan.walls[0][0]).norm(); };
  EXPECT_GT(std::abs(width(tape_measured(table)) - 0.6), 1e-5);
  EXPECT_NEAR(width(tape_measured(table, {.body_m = 0.6})), 0.6, 1e-12);
}

TEST(TapeMeasured, NeighboursInLineDoNotSendTheirCornerAway) {
  // A wall in three straight pieces, and one that bends by 5 degrees.
  const FloorPlan plan{{{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {7.99, 0.174}, {7.99, 4}, {0, 4}, {0, 0}}}};
  for (int seed = 0; seed < 500; ++seed) {
    const FloorPlan measured = tape_measured(plan, {.seed = seed});
    for (std::size_t k = 0; k < plan.walls[0].size(); ++k)
      EXPECT_LT((measured.walls[0][k] - plan.walls[0][k]).norm(), 0.08) << seed << " corner " << k;
  }
}

TEST(TapeMeasured, EndsThatMeetStillMeet) {
  const FloorPlan plan{{{{0, 0}, {3, 0}}, {{3, 0}, {3, 2}}, {{3, 2}, {3, 4}, {0, 4}}, {{3, 4}, {5, 6}}}};
  for (int seed = 0; seed < 50; ++seed) {
    const FloorPlan measured = tape_measured(plan, {.seed = seed});
    EXPECT_LT((measured.walls[0].back() - measured.walls[1].front()).norm(), 1e-12) << "two ends";
    EXPECT_LT((measured.walls[3].front() - measured.walls[2][1]).norm(), 1e-12) << "an end in a corner";
    // Two ends in line have no crossing; each lies on the other's line.
    const Segment2 second{measured.walls[1].front(), measured.walls[1].back()};
    EXPECT_LT((measured.walls[1].back() - measured.walls[2].front()).norm(), 0.1);
    EXPECT_GT(second.length_m(), 1.8);
  }
}

TEST(TapeMeasured, HoldsForAnyPlan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FloorPlan odd{{{},
                       {{1, 1}},
                       {{2, 2}, {2, 2}},
                       {{nan, 0}, {1, 1}},
                       {{0, 0}, {1, 0}, {0, 0}},
                       {{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 1}}}};
  const FloorPlan measured = tape_measured(odd);
  ASSERT_EQ(measured.walls.size(), odd.walls.size());
  for (std::size_t i : {0U, 1U, 2U}) EXPECT_EQ(measured.walls[i], odd.walls[i]);
  EXPECT_TRUE(std::isnan(measured.walls[3][0].x()));
  EXPECT_EQ(measured.walls[4].size(), 3U);
  EXPECT_EQ(measured.walls[5].size(), 3U) << "pieces of no length are left out";
  for (std::size_t i : {4U, 5U})
    for (const Eigen::Vector2d& corner : measured.walls[i]) EXPECT_TRUE(corner.allFinite());
  EXPECT_TRUE(tape_measured({}).walls.empty());
}

}  // namespace
}  // namespace beaconless::sim
