// SPDX-License-Identifier: Apache-2.0
// What the fit of every beam to its wall has to give where theory tells the answer.
#include <gtest/gtest.h>

#include "tests/support/people.hpp"
#include "tests/support/wall_room.hpp"

namespace beaconless {
namespace {

using test::WallRoom;

/// The ends of beams without noise, and not rounded to floats as those of a scan.
std::vector<Eigen::Vector2d> exact_points(const RayCaster& walls, const Pose2& from) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 1081; ++i) {
    const double bearing = radians(-135.0 + 0.25 * i);
    const double heading = from.theta_rad + bearing;
    const auto hit = walls.cast(from.translation(), {std::cos(heading), std::sin(heading)}, 30.0);
    if (hit) points.emplace_back(hit->range_m * std::cos(bearing), hit->range_m * std::sin(bearing));
  }
  return points;
}

/// Pairs are made again only where ends of beams have moved by more than noise, so that the last digits come
/// with the next match from where the one before ended, as scan follows scan.
TEST(WallsOracles, WithoutNoiseThereIsNoError) {
  for (const FloorPlan& plan : {test::rectangle(4, 4), test::niche_room(), test::rectangle(30, 20),
                                test::l_room(), test::rack_hall()}) {
    WallRoom room(plan, 61);
    double worst_first_m = 0.0;
    double worst_m = 0.0;
    double worst_rad = 0.0;
    for (int run = 0; run < 200; ++run) {
      const Pose2 truth = room.anywhere();
      const auto points = exact_points(room.walls, truth);
      const MatchResult first =
          match_walls(points, room.index, room.near(truth, 0.04, 0.02), 0.1, room.config, room.scratch);
      const MatchResult match =
          match_walls(points, room.index, first.map_from_laser, 0.01, room.config, room.scratch);
      worst_first_m = std::max(worst_first_m, distance_m(first.map_from_laser, truth));
      worst_m = std::max(worst_m, distance_m(match.map_from_laser, truth));
      worst_rad = std::max(worst_rad, heading_difference_rad(match.map_from_laser, truth));
    }
    EXPECT_LT(worst_first_m, 1e-4) << "a fifth of what noise leaves";
    EXPECT_LT(worst_m, 1e-6);
    EXPECT_LT(worst_rad, 1e-7);
  }
}

/// In a square room seen from its middle the bound has a closed form; what is reached scatters with the runs.
TEST(WallsOracles, ErrorsScatterByTheBound) {
  WallRoom room(test::rectangle(4, 4), 62);
  const Pose2 truth{2.0, 2.0, 0.3};
  test::Trial trial;
  for (int run = 0; run < 2000; ++run)
    trial.add(room.match(room.see(truth), room.near(truth, 0.003, 0.003), 0.01), truth, room.bound(truth));
  EXPECT_GT(trial.position_ratio(), 0.95);
  EXPECT_LT(trial.position_ratio(), 1.15);
  EXPECT_GT(trial.heading_ratio(), 0.95);
  EXPECT_LT(trial.heading_ratio(), 1.15);
}

TEST(WallsOracles, HalfOfTheBeamsOnPeopleCostLessThanHalfOfTheAccuracy) {
  WallRoom room(test::niche_room(), 63);
  test::Trial clean;
  test::Trial crowded;
  for (int run = 0; run < 500; ++run) {
    const Pose2 truth = room.anywhere();
    const RawScan raw = room.see(truth);
    const Pose2 guess = room.near(truth, 0.01, 0.01);
    const Eigen::Matrix3d bound = room.bound(truth);
    clean.add(room.match(raw, guess, 0.05), truth, bound);
    crowded.add(room.match(test::among_people(raw, 0.5, room.rng), guess, 0.05), truth, bound);
  }
  EXPECT_LT(crowded.position_ratio(), 2.0 * clean.position_ratio());
  EXPECT_LT(crowded.heading_ratio(), 2.0 * clean.heading_ratio());
}

/// A panel stands closer in front of a wall than noise tells apart.
TEST(WallsOracles, APanelJustBeforeAWallIsNotTheWall) {
  for (const double gap_m : {0.01, 0.025, 0.05})
    for (const bool is_mirrored :
         {false, true}) {  // beams come to the panel from the wall, or leave it for it
      FloorPlan plan = test::rectangle(6, 5);
      const double from = is_mirrored ? 0.0 : 1.5;
      plan.walls.push_back({{from, 5.0}, {from, 5.0 - gap_m}, {from + 4.5, 5.0 - gap_m}, {from + 4.5, 5.0}});
      WallRoom room(plan, 64);
      const Pose2 truth{3.0, 2.5, kPi / 2.0};
      constexpr int kRuns = 400;
      Eigen::Vector3d bias = Eigen::Vector3d::Zero();
      for (int run = 0; run < kRuns; ++run) {
        const Pose2 found = room.match(room.see(truth), room.near(truth, 0.003, 0.003), 0.01).map_from_laser;
        bias += Eigen::Vector3d(found.x_m - truth.x_m, found.y_m - truth.y_m,
                                wrap_angle(found.theta_rad - truth.theta_rad)) /
                kRuns;
      }
      const Eigen::Vector3d sigma = room.bound(truth).diagonal().cwiseSqrt();
      for (int k = 0; k < 3; ++k)
        EXPECT_LT(std::abs(bias[k]), 0.25 * sigma[k]) << gap_m << " m, mirrored " << is_mirrored << ", " << k;
    }
}

}  // namespace
}  // namespace beaconless
