// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/icp.hpp"

#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using test::niche_room;
using test::points_of;
using test::rectangle;
using test::sweep;

struct Setting {
  FloorPlan plan = niche_room();
  RayCaster walls{plan.segments()};
  WallIndex index{plan};
  IcpConfig config;
  IcpScratch scratch;
  Rng rng{11};

  std::vector<Eigen::Vector2d> see(const Pose2& from, double sigma_m = 0.0) {
    return points_of(Scan::make(sweep(walls, from, sigma_m, rng)).value());
  }
};

Pose2 off(const Pose2& pose, Rng& rng, double metres, double rad) {
  return {pose.x_m + rng.uniform(-metres, metres), pose.y_m + rng.uniform(-metres, metres),
          pose.theta_rad + rng.uniform(-rad, rad)};
}

TEST(Icp, FindsThePoseExactlyWithoutNoise) {
  Setting s;
  for (int i = 0; i < 50; ++i) {
    const Pose2 truth{s.rng.uniform(1.0, 5.0), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
    const MatchResult match =
        match_icp(s.see(truth), s.index, off(truth, s.rng, 0.08, 0.06), s.config, s.scratch);
    ASSERT_EQ(match.status, MatchStatus::converged);
    ASSERT_EQ(match.rank, 3);
    // Ranges are floats: 30 m / 2^24 a beam.
    ASSERT_LT(distance_m(match.map_from_laser, truth), 2e-6) << truth;
    ASSERT_LT(heading_difference_rad(match.map_from_laser, truth), 1e-6);
    ASSERT_EQ(match.on_map_ratio, 1.0);
  }
}

TEST(Icp, BothSolversAndAllLossesEndInTheSamePlaceInACleanRoom) {
  Setting s;
  const Pose2 truth{3.0, 2.0, 0.4};
  const auto points = s.see(truth, 0.01);
  const Pose2 guess = off(truth, s.rng, 0.05, 0.03);
  const Pose2 mixed = match_icp(points, s.index, guess, s.config, s.scratch).map_from_laser;
  s.config.solver = IcpSolver::alignment;
  s.config.max_iterations = 500;
  const Pose2 alignment = match_icp(points, s.index, guess, s.config, s.scratch).map_from_laser;
  // Steps below converged_m end the linearly convergent solver that far from its limit, or a few times that.
  EXPECT_LT(distance_m(mixed, alignment), 2e-4);
  for (const LossKind loss : {LossKind::cauchy, LossKind::tukey, LossKind::welsch, LossKind::geman_mcclure}) {
    s.config.loss = loss;
    const MatchResult other = match_icp(points, s.index, guess, s.config, s.scratch);
    // All are 95 % efficient: they differ by a fraction of their own standard deviation.
    EXPECT_LT(distance_m(mixed, other.map_from_laser),
              3.0 * std::sqrt(other.covariance.topLeftCorner<2, 2>().trace()));
  }
}

TEST(Icp, MovingTheMapMovesTheAnswerWithIt) {
  Setting s;
  const Pose2 truth{3.0, 2.0, 0.4};
  const auto points = s.see(truth, 0.01);
  const Pose2 guess{3.05, 1.97, 0.42};
  const Pose2 moved_from_map{-40.0, 25.0, 2.1};
  FloorPlan moved = s.plan;
  for (auto& wall : moved.walls)
    for (auto& corner : wall) corner = moved_from_map * corner;
  const MatchResult here = match_icp(points, s.index, guess, s.config, s.scratch);
  const MatchResult there = match_icp(points, WallIndex(moved), moved_from_map * guess, s.config, s.scratch);
  EXPECT_LT(distance_m(there.map_from_laser, moved_from_map * here.map_from_laser), 1e-6);
  EXPECT_LT(heading_difference_rad(there.map_from_laser, moved_from_map * here.map_from_laser), 1e-7);
}

TEST(Icp, ErrorsAreAsLargeAsTheCovarianceSays) {
  Setting s;
  const int runs = 600;
  double nees = 0.0;
  for (int i = 0; i < runs; ++i) {
    const Pose2 truth{s.rng.uniform(1.0, 5.0), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
    const MatchResult match =
        match_icp(s.see(truth, 0.01), s.index, off(truth, s.rng, 0.02, 0.01), s.config, s.scratch);
    const Eigen::Vector3d error(match.map_from_laser.x_m - truth.x_m, match.map_from_laser.y_m - truth.y_m,
                                wrap_angle(match.map_from_laser.theta_rad - truth.theta_rad));
    nees += error.dot(match.covariance.inverse() * error);
  }
  // The mean of chi-square(3) over the runs, at 99 % (2.58 sigma), and 10 % for beams near corners, whose
  // nearest wall is not the one they hit.
  EXPECT_NEAR(nees / runs, 3.0, 0.3 + 2.58 * std::sqrt(6.0 / runs));
}

TEST(Icp, AThirdOfTheBeamsOnPeopleDoesNotMoveThePose) {
  Setting s;
  const Pose2 truth{3.0, 2.0, 0.4};
  double worst = 0.0;
  for (int i = 0; i < 20; ++i) {
    auto points = s.see(truth, 0.01);
    // Two people, each a run of beams a metre and more nearer than the wall.
    const auto begin = static_cast<std::size_t>(s.rng.uniform(0.0, 300.0));
    for (std::size_t k = begin; k < begin + 180; ++k) points[k] = points[k].normalized() * 0.9;
    for (std::size_t k = begin + 400; k < begin + 580; ++k) points[k] = points[k].normalized() * 1.1;
    const MatchResult match = match_icp(points, s.index, off(truth, s.rng, 0.02, 0.01), s.config, s.scratch);
    worst = std::max(worst, distance_m(match.map_from_laser, truth));
    EXPECT_LT(match.on_map_ratio, 0.75);
  }
  EXPECT_LT(worst, 0.006);  // ten of the bound's sigmas; without the gate it is centimetres
}

TEST(Icp, InACorridorTheDirectionAlongItIsLeftAtTheGuess) {
  // The corridor's ends are out of range: the scan says nothing about x.
  Setting s;
  s.plan = FloorPlan{{{{-100, 0}, {100, 0}}, {{-100, 2.5}, {100, 2.5}}}};
  s.walls = RayCaster(s.plan.segments());
  s.index = WallIndex(s.plan);
  const Pose2 truth{0.0, 1.0, 0.1};
  const Pose2 guess{0.2, 1.05, 0.12};
  const MatchResult match = match_icp(s.see(truth, 0.01), s.index, guess, s.config, s.scratch);
  EXPECT_EQ(match.rank, 2);
  EXPECT_NEAR(std::abs(match.weak_direction.x()), 1.0, 1e-3);
  EXPECT_NEAR(match.map_from_laser.x_m, guess.x_m, 1e-3);
  EXPECT_NEAR(match.map_from_laser.y_m, truth.y_m, 0.003);
  EXPECT_NEAR(match.map_from_laser.theta_rad, truth.theta_rad, 0.002);
  EXPECT_GT(match.covariance(0, 0), 1e4);
  EXPECT_LT(match.covariance(1, 1), 1e-5);
}

TEST(Icp, TooLittleToHoldOnToLeavesTheGuess) {
  Setting s;
  const Pose2 guess{1.0, 2.0, 0.3};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& points : {std::vector<Eigen::Vector2d>{},
                             {{0.5, 0.1}},
                             std::vector<Eigen::Vector2d>(50, {500, 500}),
                             std::vector<Eigen::Vector2d>(50, {nan, 1.0})}) {
    const MatchResult match = match_icp(points, s.index, guess, s.config, s.scratch);
    EXPECT_EQ(match.status, MatchStatus::too_few_pairs);
    EXPECT_FALSE(match.usable());
    EXPECT_EQ(match.map_from_laser, guess);
    EXPECT_TRUE(match.covariance.allFinite());
  }
}

TEST(Icp, AllPointsInOnePlaceGiveNoHeadingAndNoNonsense) {
  Setting s;
  const std::vector<Eigen::Vector2d> points(100, {1.0, 0.0});
  const MatchResult match = match_icp(points, s.index, {1.0, 4.9, 1.57}, s.config, s.scratch);
  EXPECT_LT(match.rank, 3);
  EXPECT_TRUE(match.map_from_laser.is_finite());
  EXPECT_TRUE(match.covariance.allFinite());
}

}  // namespace
}  // namespace beaconless
