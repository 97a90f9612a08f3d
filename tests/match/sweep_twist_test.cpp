// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/sweep_twist.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "beaconless/map/rasterize.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kSweep_s = 0.094;  // three quarters of a turn at 8 Hz
constexpr double kSigma_m = 0.01;
constexpr int kBeams = 541;

/// What a moving laser saw, as if it had stood still, and when.
struct Bent {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> times_s;
};

Bent bent_sweep(const RayCaster& walls, const Pose2& map_from_laser, const Twist2& per_s, double sigma_m,
                Rng& rng) {
  Bent bent;
  for (int i = 0; i < kBeams; ++i) {
    const double time_s = kSweep_s * i / (kBeams - 1);
    const double bearing = radians(-135.0) + radians(270.0) * i / (kBeams - 1);
    const Pose2 then = map_from_laser * Pose2::exp(time_s * per_s);
    const double heading = then.theta_rad + bearing;
    const auto hit = walls.cast(then.translation(), {std::cos(heading), std::sin(heading)}, 30.0);
    if (!hit) continue;
    const double range_m = hit->range_m + rng.normal(sigma_m);
    bent.points.emplace_back(range_m * std::cos(bearing), range_m * std::sin(bearing));
    bent.times_s.push_back(time_s);
  }
  return bent;
}

/// A fit puts a bent sweep where its middle was, more or less.
Pose2 fitted(const Pose2& map_from_laser, const Twist2& per_s) {
  return map_from_laser * Pose2::exp(0.5 * kSweep_s * per_s);
}

double nees(const SweepTwist& told, const Twist2& truth) {
  const Eigen::Vector3d error = told.correction_per_s - truth.vector();
  return error.dot(told.covariance.ldlt().solve(error));
}

void expect_sound(const SweepTwist& told) {
  ASSERT_TRUE(told.correction_per_s.allFinite());
  ASSERT_TRUE(told.covariance.allFinite());
  ASSERT_LE((told.covariance - told.covariance.transpose()).norm(), 1e-9 * told.covariance.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(told.covariance, Eigen::EigenvaluesOnly);
  ASSERT_GT(eigen.eigenvalues().minCoeff(), 0.0);
}

/// Told of how many sweeps of unknown motions somewhere in the room, how far it was off.
struct Told {
  double mean_nees = 0.0;
  double rmse_mps = 0.0;
  double rmse_radps = 0.0;
  int count = 0;
};

/// Seen by the motion told so far, again and again; a fit by a wrong motion is off by half of what is wrong.
Told told_of_many(const SurfaceMap& map, const SweepNoise& noise, double most_mps, int steps) {
  constexpr int kRuns = 400;
  Rng rng(41);
  const RayCaster walls(test::niche_room().segments());
  Told all;
  for (int run = 0; run < kRuns; ++run) {
    const Pose2 truth{rng.uniform(2.8, 5.2), rng.uniform(0.8, 4.2), rng.uniform(-kPi, kPi)};
    const Twist2 per_s{rng.uniform(-most_mps, most_mps), 0.3 * rng.uniform(-most_mps, most_mps),
                       rng.uniform(-most_mps, most_mps)};
    const Bent bent = bent_sweep(walls, truth, per_s, kSigma_m, rng);
    SweepTwist told;
    for (int step = 0; step < steps; ++step) {
      const Eigen::Vector3d assumed = told.correction_per_s;
      const Eigen::Vector3d missed = per_s.vector() - assumed;
      const Pose2 off{rng.normal(0.002), rng.normal(0.002), rng.normal(0.001)};
      std::vector<Eigen::Vector2d> points;
      for (std::size_t i = 0; i < bent.points.size(); ++i)
        points.push_back(Pose2::exp(bent.times_s[i] * Twist2{assumed.x(), assumed.y(), assumed.z()}) *
                         bent.points[i]);
      const Pose2 fit = fitted(truth, {missed.x(), missed.y(), missed.z()}) * off;
      const auto bend = twist_of_sweep(points, bent.times_s, map, fit, noise);
      if (!bend) return all;
      told = *bend;
      told.correction_per_s += assumed;
    }
    expect_sound(told);
    const Eigen::Vector3d error = told.correction_per_s - per_s.vector();
    all.mean_nees += nees(told, per_s) / kRuns;
    all.rmse_mps += error.head<2>().squaredNorm() / kRuns;
    all.rmse_radps += error.z() * error.z() / kRuns;
    ++all.count;
  }
  all.rmse_mps = std::sqrt(all.rmse_mps);
  all.rmse_radps = std::sqrt(all.rmse_radps);
  return all;
}

// Measured: 2.8, 38 mm/s, 11 mrad/s. A mean of 400 is within 0.5 of 3 where covariances are honest; beams are
// weighed down as they are off, which is why they are a little more careful.
TEST(SweepTwist, OnWallsItIsAsSureAsItIsRight) {
  const Told told = told_of_many(WallIndex(test::niche_room()), {.sigma_m = kSigma_m}, 0.08, 1);
  ASSERT_EQ(told.count, 400);
  EXPECT_GT(told.mean_nees, 2.0);
  EXPECT_LT(told.mean_nees, 3.5);
  EXPECT_LT(told.rmse_mps, 0.05);
  EXPECT_LT(told.rmse_radps, 0.015);
}

/// A step is as good as the pairs of beams and walls; far from the truth it takes more of them.
TEST(SweepTwist, AFastMotionIsToldStepByStep) {
  const WallIndex map(test::niche_room());
  const SweepNoise noise{.sigma_m = kSigma_m};
  const Told once = told_of_many(map, noise, 0.4, 1);
  const Told often = told_of_many(map, noise, 0.4, 4);
  ASSERT_EQ(often.count, 400);
  EXPECT_GT(once.mean_nees, 5.0) << "or one would do";
  EXPECT_LT(often.mean_nees, 4.2) << "3.5 was measured";
  EXPECT_LT(often.rmse_mps, 0.05);
}

TEST(SweepTwist, OnCellsItIsNotSurerThanItIsRight) {
  const auto grid = rasterize(test::niche_room(), {.resolution_m = 0.05}).value();
  const SweepNoise noise{.sigma_m = kSigma_m, .map_sigma_m = 0.05 / std::sqrt(12.0)};
  const Told told = told_of_many(CellIndex(grid), noise, 0.25, 1);
  ASSERT_EQ(told.count, 400);
  EXPECT_LT(told.mean_nees, 3.5);
  EXPECT_LT(told.rmse_mps, 0.2);
}

TEST(SweepTwist, OfTheRightMotionNothingIsLeft) {
  Rng rng(42);
  const FloorPlan room = test::niche_room();
  const Bent still = bent_sweep(RayCaster(room.segments()), {3, 2, 0.4}, Twist2{}, 0.0, rng);
  const auto told = twist_of_sweep(still.points, still.times_s, WallIndex(room), {3, 2, 0.4}, {});
  ASSERT_TRUE(told);
  EXPECT_LT(told->correction_per_s.norm(), 1e-9);
}

TEST(SweepTwist, TheFittedPoseMayBeOff) {
  Rng rng(43);
  const FloorPlan room = test::niche_room();
  const WallIndex map(room);
  const Twist2 per_s{0.1, 0.03, -0.1};
  const Pose2 at{3, 2, 0.4};
  const Bent bent = bent_sweep(RayCaster(room.segments()), at, per_s, 0.0, rng);
  for (const Pose2& off : {Pose2{}, Pose2{0.01, 0, 0}, Pose2{0, -0.01, 0}, Pose2{0, 0, 0.003}}) {
    const auto told = twist_of_sweep(bent.points, bent.times_s, map, fitted(at, per_s) * off, {});
    ASSERT_TRUE(told);
    EXPECT_LT((told->correction_per_s - per_s.vector()).norm(), 0.02) << off;
  }
}

TEST(SweepTwist, BeamsMayComeInAnyOrderAndAtAnyTimeOfTheSweep) {
  Rng rng(44);
  const FloorPlan room = test::niche_room();
  const WallIndex map(room);
  const Twist2 per_s{0.1, 0.03, -0.1};
  const Pose2 at{3, 2, 0.4};
  Bent bent = bent_sweep(RayCaster(room.segments()), at, per_s, 0.001, rng);
  const auto told = twist_of_sweep(bent.points, bent.times_s, map, fitted(at, per_s), {});
  std::reverse(bent.points.begin(), bent.points.end());
  std::reverse(bent.times_s.begin(), bent.times_s.end());
  for (double& time_s : bent.times_s) time_s -= 7.0;
  const auto other = twist_of_sweep(bent.points, bent.times_s, map, fitted(at, per_s), {});
  ASSERT_TRUE(told && other);
  EXPECT_LT((told->correction_per_s - other->correction_per_s).norm(), 1e-9);
  EXPECT_LT((told->covariance - other->covariance).norm(), 1e-9);
}

TEST(SweepTwist, AShorterSweepTellsLess) {
  Rng rng(45);
  const FloorPlan room = test::niche_room();
  Bent bent = bent_sweep(RayCaster(room.segments()), {3, 2, 0.4}, Twist2{}, kSigma_m, rng);
  const auto slow = twist_of_sweep(bent.points, bent.times_s, WallIndex(room), {3, 2, 0.4}, {});
  for (double& time_s : bent.times_s) time_s *= 0.2;
  const auto fast = twist_of_sweep(bent.points, bent.times_s, WallIndex(room), {3, 2, 0.4}, {});
  ASSERT_TRUE(slow && fast);
  EXPECT_LT((fast->covariance - 25.0 * slow->covariance).norm(), 1e-6 * fast->covariance.norm());
}

TEST(SweepTwist, NothingWhereBeamsCameAllAtOnceOrAreTooFew) {
  Rng rng(46);
  const FloorPlan room = test::niche_room();
  const WallIndex map(room);
  const Pose2 at{3, 2, 0.4};
  const Bent bent = bent_sweep(RayCaster(room.segments()), at, Twist2{}, kSigma_m, rng);
  const auto of = [&](std::size_t beams, std::size_t times) {
    return twist_of_sweep(std::span(bent.points).first(beams), std::span(bent.times_s).first(times), map, at,
                          {});
  };
  EXPECT_TRUE(of(bent.points.size(), bent.times_s.size()));
  EXPECT_FALSE(of(0, 0));
  EXPECT_FALSE(of(29, 29));
  EXPECT_FALSE(of(bent.points.size(), bent.times_s.size() - 1)) << "whose times?";
  const std::vector<double> at_once(bent.points.size(), 0.02);
  EXPECT_FALSE(twist_of_sweep(bent.points, at_once, map, at, {}));
  EXPECT_FALSE(twist_of_sweep(bent.points, bent.times_s, map, {300, 300, 0}, {})) << "no wall is near";
}

/// The walls of a corridor do not tell how fast the robot drives along them.
TEST(SweepTwist, AlongACorridorNothingIsTold) {
  Rng rng(47);
  const FloorPlan corridor{{{{-100, 0}, {100, 0}}, {{-100, 2.5}, {100, 2.5}}}};
  const RayCaster walls(corridor.segments());
  const WallIndex map(corridor);
  for (const double heading : {0.0, 0.3, radians(90.0), -2.0, 1.0}) {
    for (const double sigma_m : {0.0, kSigma_m}) {
      const Pose2 at{0.3, 1.1, heading};
      const Bent bent = bent_sweep(walls, at, {0.1, 0.0, 0.1}, sigma_m, rng);
      const auto told = twist_of_sweep(bent.points, bent.times_s, map, at, {});
      if (!told) continue;
      expect_sound(*told);
      const Eigen::Vector3d along(std::cos(heading), -std::sin(heading), 0.0);  // in the laser frame
      EXPECT_GT(std::sqrt(along.dot(told->covariance * along)), 10.0) << "m/s, heading " << heading;
    }
  }
}

/// Nor does a round room how fast it turns.
TEST(SweepTwist, InARoundRoomTheTurnIsNotTold) {
  Rng rng(48);
  std::vector<Eigen::Vector2d> wall;
  for (int i = 0; i <= 720; ++i)
    wall.emplace_back(3.0 * std::cos(radians(0.5 * i)), 3.0 * std::sin(radians(0.5 * i)));
  const FloorPlan round{{wall}};
  const Bent bent = bent_sweep(RayCaster(round.segments()), {0, 0, 0.2}, {0.0, 0.0, 0.3}, kSigma_m, rng);
  const auto told = twist_of_sweep(bent.points, bent.times_s, WallIndex(round), {0, 0, 0.2}, {});
  if (told) {
    EXPECT_GT(std::sqrt(told->covariance(2, 2)), 0.5);
  }
}

TEST(SweepTwist, ThingsThatAreOnNoMapDoNotBendIt) {
  Rng rng(49);
  const FloorPlan room = test::niche_room();
  const Twist2 per_s{0.1, 0.03, -0.1};
  const Pose2 at{3, 2, 0.4};
  Bent bent = bent_sweep(RayCaster(room.segments()), at, per_s, kSigma_m, rng);
  for (std::size_t i = 100; i < 160; ++i) bent.points[i] *= 0.6;  // somebody stands there
  const auto told = twist_of_sweep(bent.points, bent.times_s, WallIndex(room), fitted(at, per_s), {});
  ASSERT_TRUE(told);
  EXPECT_LT(nees(*told, per_s), 16.0);
}

TEST(SweepTwist, NeverTellsNan) {
  Rng rng(50);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const FloorPlan room = test::niche_room();
  const RayCaster walls(room.segments());
  const auto grid = rasterize(room, {.resolution_m = 0.05}).value();
  const SurfaceMap maps[] = {WallIndex(room), CellIndex(grid)};
  const double odd[] = {nan, inf, -inf, 0.0, 1e300, -1e300, 1e-300};
  const auto any_odd = [&] { return odd[static_cast<std::size_t>(rng.uniform(0.0, std::size(odd)))]; };
  int told_count = 0;
  for (int run = 0; run < 2000; ++run) {
    const Pose2 at{3, 2, rng.uniform(-kPi, kPi)};
    Bent bent = bent_sweep(walls, at, {0.1, 0.0, 0.1}, kSigma_m, rng);
    const int spoiled = static_cast<int>(rng.uniform(0.0, 4.0));
    for (int k = 0; k < spoiled; ++k) {
      const auto i = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(bent.points.size())));
      bent.points[i] = {any_odd(), any_odd()};
      if (rng.uniform() < 0.3) bent.times_s[i] = any_odd();
    }
    SweepNoise noise;
    if (run % 5 == 1) noise.sigma_m = 0.0;
    if (run % 5 == 2) noise = {0.0, 0.0, 0.0};
    if (run % 5 == 3) noise.scale_m = any_odd();
    if (run % 5 == 4) noise.map_sigma_m = any_odd();
    const auto told = twist_of_sweep(bent.points, bent.times_s, maps[run % 2], at, noise);
    if (!told) continue;
    ++told_count;
    ASSERT_TRUE(told->correction_per_s.allFinite() && told->covariance.allFinite()) << run;
  }
  EXPECT_GT(told_count, 300) << "not all of it is nonsense";
}

}  // namespace
}  // namespace beaconless
