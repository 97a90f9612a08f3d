// SPDX-License-Identifier: Apache-2.0
// What holds for any fit of beams to walls, whatever the room: it does not matter where the map's origin is,
// how the laser is turned, in what order beams come, or in what unit lengths are told.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/wall_room.hpp"

namespace beaconless {
namespace {

using test::WallRoom;

struct Case {
  std::vector<Eigen::Vector2d> points;
  Pose2 truth;
  Pose2 guess;
};

std::vector<Case> cases_in(WallRoom& room, int count) {
  std::vector<Case> cases;
  for (int i = 0; i < count; ++i) {
    const Pose2 truth = room.anywhere();
    cases.push_back(
        {test::points_of(Scan::make(room.see(truth)).value()), truth, room.near(truth, 0.005, 0.005)});
  }
  return cases;
}

FloorPlan moved(const Pose2& by, FloorPlan plan) {
  for (auto& wall : plan.walls)
    for (Eigen::Vector2d& corner : wall) corner = by * corner;
  return plan;
}

void expect_same(const Pose2& one, const Pose2& other, double slack) {
  EXPECT_LT(distance_m(one, other), slack);
  EXPECT_LT(heading_difference_rad(one, other), slack);
}

class WallsProperties : public testing::Test {
 protected:
  WallsProperties() : room(test::niche_room(), 71) {}

  MatchResult match(const std::vector<Eigen::Vector2d>& points, const Pose2& guess) {
    return match_walls(points, room.index, guess, 0.02, room.config, room.scratch);
  }

  WallRoom room;
};

TEST_F(WallsProperties, AMovedMapMovesTheEstimate) {
  for (const Pose2 by : {Pose2{3.0, -2.0, 0.7}, Pose2{-40.0, 25.0, -2.1}, Pose2{0.013, 0.027, kPi / 2.0}}) {
    const WallIndex elsewhere(moved(by, room.plan));
    for (const Case& of : cases_in(room, 100)) {
      const MatchResult here = match(of.points, of.guess);
      const MatchResult there =
          match_walls(of.points, elsewhere, by * of.guess, 0.02, room.config, room.scratch);
      expect_same(by * here.map_from_laser, there.map_from_laser, 1e-9);
      Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
      turn.topLeftCorner<2, 2>() = by.rotation();
      EXPECT_LT((turn * here.covariance * turn.transpose() - there.covariance).norm(),
                1e-6 * here.covariance.norm());
    }
  }
}

TEST_F(WallsProperties, ATurnedLaserTurnsTheEstimate) {
  for (const double turn : {0.25, kPi / 2.0, -3.0})
    for (const Case& of : cases_in(room, 100)) {
      const Pose2 old_from_new{0.0, 0.0, turn};
      std::vector<Eigen::Vector2d> turned;
      for (const Eigen::Vector2d& point : of.points) turned.push_back(old_from_new.inverse() * point);
      expect_same(match(of.points, of.guess).map_from_laser * old_from_new,
                  match(turned, of.guess * old_from_new).map_from_laser, 1e-9);
    }
}

TEST_F(WallsProperties, BeamsComeInAnyOrder) {
  for (const Case& of : cases_in(room, 300)) {
    std::vector<Eigen::Vector2d> backwards(of.points.rbegin(), of.points.rend());
    expect_same(match(of.points, of.guess).map_from_laser, match(backwards, of.guess).map_from_laser, 1e-9);
  }
}

/// The steps at which a fit ends are fixed, and now and then that pairs a beam otherwise: so this holds to a
/// part of what a fit scatters by, not to the last digit.
TEST_F(WallsProperties, LengthsHaveNoUnit) {
  for (const double scale : {0.5, 3.0}) {
    FloorPlan large = room.plan;
    for (auto& wall : large.walls)
      for (Eigen::Vector2d& corner : wall) corner *= scale;
    const WallIndex index(large, scale, 0.1 * scale);
    WallsConfig config = room.config;
    for (double* length : {&config.sigma_m, &config.gate_m, &config.near_gate_m, &config.on_map_m,
                           &config.unobservable_sigma_m})
      *length *= scale;
    Eigen::Vector2d squares = Eigen::Vector2d::Zero();  // of what differs, in standard deviations
    constexpr int kCases = 200;
    for (const Case& of : cases_in(room, kCases)) {
      std::vector<Eigen::Vector2d> points;
      for (const Eigen::Vector2d& point : of.points) points.emplace_back(scale * point);
      const auto scaled = [&](const Pose2& pose) {
        return Pose2{scale * pose.x_m, scale * pose.y_m, pose.theta_rad};
      };
      const MatchResult here = match(of.points, of.guess);
      const MatchResult there =
          match_walls(points, index, scaled(of.guess), 0.02 * scale, config, room.scratch);
      const double sigma_m = std::sqrt(here.covariance.topLeftCorner<2, 2>().trace());
      const double metres = distance_m(scaled(here.map_from_laser), there.map_from_laser) / (scale * sigma_m);
      const double turn = heading_difference_rad(here.map_from_laser, there.map_from_laser) /
                          std::sqrt(here.covariance(2, 2));
      squares += Eigen::Vector2d(metres * metres, turn * turn) / kCases;
    }
    EXPECT_LT(std::sqrt(squares.x()), 0.05);
    EXPECT_LT(std::sqrt(squares.y()), 0.05);
  }
}

/// Beams that tell nothing are gone, and those that are left tell as much as before.
TEST_F(WallsProperties, BrokenBeamsAreMissedAndNoMore) {
  const std::array<float, 4> broken{std::numeric_limits<float>::quiet_NaN(),
                                    std::numeric_limits<float>::infinity(),
                                    -std::numeric_limits<float>::infinity(), 0.0F};
  test::Trial whole;
  test::Trial torn;
  for (int run = 0; run < 500; ++run) {
    const Pose2 truth = room.anywhere();
    RawScan raw = room.see(truth);
    const Pose2 guess = room.near(truth, 0.005, 0.005);
    const Eigen::Matrix3d bound = room.bound(truth);
    whole.add(room.match(raw, guess, 0.02), truth, bound);
    for (float& range : raw.ranges_m)
      if (room.rng.uniform() < 0.3) range = broken[room.rng.bits() % broken.size()];
    const MatchResult match = room.match(raw, guess, 0.02);
    ASSERT_EQ(match.status, MatchStatus::converged);
    ASSERT_EQ(match.rank, 3);
    torn.add(match, truth, bound);
  }
  // Seven tenths of the beams know seven tenths of the information; and 500 runs scatter.
  EXPECT_LT(torn.position_ratio(), 1.05 * whole.position_ratio() / std::sqrt(0.7));
  EXPECT_LT(torn.heading_ratio(), 1.05 * whole.heading_ratio() / std::sqrt(0.7));
  EXPECT_NEAR(torn.mean_nees(), 3.0, torn.nees_slack());
}

TEST_F(WallsProperties, AFewBeamsAreTooFew) {
  const Case of = cases_in(room, 1).front();
  for (const std::size_t count : {0, 1, 2}) {
    const std::vector<Eigen::Vector2d> few(of.points.begin(),
                                           of.points.begin() + static_cast<std::ptrdiff_t>(count));
    const MatchResult result = match(few, of.guess);
    EXPECT_EQ(result.status, MatchStatus::too_few_pairs) << count;
    EXPECT_EQ(result.map_from_laser, of.guess);
    EXPECT_EQ(result.rank, 0);
  }
}

}  // namespace
}  // namespace beaconless
