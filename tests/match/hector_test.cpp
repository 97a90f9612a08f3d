// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "beaconless/map/grid_builder.hpp"
#include "beaconless/map/rasterize.hpp"
#include "beaconless/match/icp.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

FloorPlan moved(FloorPlan plan, const Pose2& motion) {
  for (auto& wall : plan.walls)
    for (auto& corner : wall) corner = motion * corner;
  return plan;
}

/// A building with its pyramid, and a scanner in it.
struct Setting {
  explicit Setting(const FloorPlan& of) : Setting(of, build_pyramid(of).value()) {}
  Setting(const FloorPlan& of, OccupancyPyramid with) : plan(of), pyramid(std::move(with)) {}

  FloorPlan plan;
  OccupancyPyramid pyramid;
  RayCaster walls{plan.segments()};
  HectorConfig config;
  HectorScratch scratch;
  Rng rng{11};

  Points see(const Pose2& from, double sigma_m = 0.0) {
    return test::points_of(Scan::make(test::sweep(walls, from, sigma_m, rng)).value());
  }
  MatchResult match(const Points& points, const Pose2& guess) {
    return match_hector(points, pyramid, guess, config, scratch);
  }
  Pose2 off(const Pose2& pose, double metres, double rad) {
    return {pose.x_m + rng.uniform(-metres, metres), pose.y_m + rng.uniform(-metres, metres),
            pose.theta_rad + rng.uniform(-rad, rad)};
  }
};

Setting drawn(const FloorPlan& plan, const RasterConfig& config = {}) {
  return {plan, build_pyramid(rasterize(plan, config).value()).value()};
}

Eigen::Vector3d error_of(const Pose2& found, const Pose2& truth) {
  return {found.x_m - truth.x_m, found.y_m - truth.y_m, wrap_angle(found.theta_rad - truth.theta_rad)};
}

TEST(Hector, FindsThePoseInCellsAsOnTheWallsThemselves) {
  Setting s(test::niche_room());
  for (int i = 0; i < 50; ++i) {
    const Pose2 truth{s.rng.uniform(1.0, 5.0), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
    const MatchResult match = s.match(s.see(truth), s.off(truth, 0.04, 0.03));
    ASSERT_TRUE(match.usable());
    ASSERT_EQ(match.rank, 3);
    ASSERT_EQ(match.iterations, 4 + 4 + 6);
    // A hundredth of a cell; the cells' offsets differ along a wall and average out.
    ASSERT_LT(distance_m(match.map_from_laser, truth), 5e-4);
    ASSERT_LT(heading_difference_rad(match.map_from_laser, truth), 3e-4);
    ASSERT_EQ(match.on_map_ratio, 1.0);
    ASSERT_LT(match.misfit, 0.02);
  }
}

TEST(Hector, ConvergesFromHalfACoarsestCellAway) {
  for (Setting s : {Setting(test::niche_room()), drawn(test::niche_room(), {.heading_rad = 0.35})})
    for (int i = 0; i < 50; ++i) {
      const Pose2 truth{s.rng.uniform(1.0, 5.0), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
      const double direction_rad = s.rng.uniform(-kPi, kPi);
      const Pose2 guess{truth.x_m + 0.1 * std::cos(direction_rad), truth.y_m + 0.1 * std::sin(direction_rad),
                        truth.theta_rad + s.rng.uniform(-0.03, 0.03)};
      const MatchResult match = s.match(s.see(truth, 0.01), guess);
      ASSERT_LT(distance_m(match.map_from_laser, truth), 0.005);
      ASSERT_LT(heading_difference_rad(match.map_from_laser, truth), 0.003);
    }
}

TEST(Hector, MatchingAScanToTheMapMadeOfItIsTheIdentity) {
  // Along the rows it is so only to the phase of the walls: two tests below.
  const Pose2 turn{0.0, 0.0, 0.3};
  Setting s(moved(test::niche_room(), turn));
  for (const double sigma_m : {0.0, 0.01})
    for (int i = 0; i < 10; ++i) {
      const Pose2 truth =
          turn * Pose2{s.rng.uniform(1.5, 4.5), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
      const Scan scan = Scan::make(test::sweep(s.walls, truth, sigma_m, s.rng)).value();
      auto builder = GridBuilder::make({.resolution_m = 0.05}).value();
      builder.add(scan, truth).value();
      Setting of_itself(s.plan, build_pyramid(builder.grid()).value());
      const MatchResult match = of_itself.match(test::points_of(scan), truth);
      ASSERT_LT(distance_m(match.map_from_laser, truth), 0.1 * 0.05);
    }
}

TEST(Hector, MovingTheMapMovesTheAnswerWithIt) {
  const OccupancyGrid grid = rasterize(test::niche_room(), {.heading_rad = 0.3}).value();
  Setting s(test::niche_room(), build_pyramid(grid).value());
  const auto points = s.see({3.0, 2.0, 0.4}, 0.01);
  const Pose2 guess{3.05, 1.97, 0.42};
  const Pose2 motion{-40.0, 25.0, 2.1};
  OccupancyGrid elsewhere = grid;
  elsewhere.map_from_grid = motion * grid.map_from_grid;
  const MatchResult here = s.match(points, guess);
  s.pyramid = build_pyramid(elsewhere).value();
  const MatchResult there = s.match(points, motion * guess);
  // Floats: a millionth of a cell a point.
  EXPECT_LT(distance_m(there.map_from_laser, motion * here.map_from_laser), 1e-6);
  EXPECT_LT(heading_difference_rad(there.map_from_laser, motion * here.map_from_laser), 1e-6);
  const Eigen::Matrix3d turn = [&] {
    Eigen::Matrix3d all = Eigen::Matrix3d::Identity();
    all.topLeftCorner<2, 2>() = motion.rotation();
    return all;
  }();
  EXPECT_LT((there.covariance - turn * here.covariance * turn.transpose()).norm(),
            1e-4 * here.covariance.norm());
}

TEST(Hector, TurningTheScannerTurnsTheAnswer) {
  Setting s(test::niche_room());
  auto points = s.see({3.0, 2.0, 0.4}, 0.01);
  const Pose2 straight = s.match(points, {3.05, 1.97, 0.42}).map_from_laser;
  for (auto& point : points) point = Pose2{0.0, 0.0, -1.3}.rotation() * point;
  const Pose2 turned = s.match(points, {3.05, 1.97, 0.42 + 1.3}).map_from_laser;
  EXPECT_LT(distance_m(straight, turned), 1e-6);
  EXPECT_NEAR(wrap_angle(turned.theta_rad - straight.theta_rad), 1.3, 1e-6);
}

TEST(Hector, TheOrderOfPointsDoesNotMoveThePoseAndBadOnesAreLeftOut) {
  Setting s(test::niche_room());
  auto points = s.see({3.0, 2.0, 0.4}, 0.01);
  const MatchResult in_order = s.match(points, {3.02, 1.97, 0.41});
  for (std::size_t i = points.size() - 1; i > 0; --i)
    std::swap(points[i], points[static_cast<std::size_t>(s.rng.uniform(0.0, static_cast<double>(i + 1)))]);
  for (int i = 0; i < 300; ++i)
    points.insert(points.begin() + 3 * i, Eigen::Vector2d(std::numeric_limits<double>::quiet_NaN(), 1.0));
  const MatchResult shuffled = s.match(points, {3.02, 1.97, 0.41});
  EXPECT_LT(distance_m(in_order.map_from_laser, shuffled.map_from_laser), 1e-6);
  EXPECT_EQ(in_order.pair_count, shuffled.pair_count);
  EXPECT_NEAR(in_order.on_map_ratio, shuffled.on_map_ratio, 1e-9);
  // What holds is then told by H alone: less sharply, but of the same size.
  const Eigen::Vector3d share = in_order.covariance.diagonal().cwiseQuotient(shuffled.covariance.diagonal());
  EXPECT_GT(share.minCoeff(), 0.4);
  EXPECT_LT(share.maxCoeff(), 2.5);
}

TEST(Hector, BothLoopsEndInTheSamePlace) {
  Setting s(test::niche_room());
  for (int i = 0; i < 20; ++i) {
    const Pose2 truth{s.rng.uniform(1.0, 5.0), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
    const auto points = s.see(truth, 0.01);
    const Pose2 guess = s.off(truth, 0.05, 0.03);
    s.scratch.loop = VectorLoop::portable;
    const Pose2 portable = s.match(points, guess).map_from_laser;
    s.scratch.loop = fastest_vector_loop();
    const Pose2 fastest = s.match(points, guess).map_from_laser;
    ASSERT_LT(distance_m(portable, fastest), 1e-6);
    ASSERT_LT(heading_difference_rad(portable, fastest), 1e-6);
  }
}

TEST(Hector, TheSameInputGivesTheSameBits) {
  Setting s(test::niche_room());
  const auto points = s.see({3.0, 2.0, 0.4}, 0.01);
  const MatchResult first = s.match(points, {3.03, 1.98, 0.38});
  s.match(s.see({2.0, 2.0, 1.4}), {2.0, 2.0, 1.4});
  HectorScratch fresh;
  const MatchResult again = match_hector(points, s.pyramid, {3.03, 1.98, 0.38}, s.config, fresh);
  EXPECT_EQ(first.map_from_laser, again.map_from_laser);
  EXPECT_EQ(first.covariance, again.covariance);
}

// Where a wall runs along the rows of drawn cells, its whole length is off by the same: the pose too, by as
// much as the middles of the cells are from the walls. This documents it; no matcher can know better.
TEST(Hector, AlongTheRowsOfDrawnCellsThePoseIsOffByThePhaseOfTheWalls) {
  const FloorPlan plan = test::rectangle(4.0, 3.0);
  for (const double phase : {0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9}) {
    Setting s = drawn(plan, {.phase_x_cells = phase, .phase_y_cells = 0.5});
    const Pose2 truth{1.7, 1.4, 0.3};
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int i = 0; i < 10; ++i)
      mean += error_of(s.match(s.see(truth, 0.01), truth).map_from_laser, truth) / 10.0;
    EXPECT_NEAR(mean.x(), (0.5 - phase) * 0.05, 0.001) << phase;
    EXPECT_NEAR(mean.y(), 0.0, 0.001) << phase;
  }
}

TEST(Hector, WhereverAPlansWallsLieInTheirCellsThePoseIsNotOff) {
  for (const double heading_deg : {0.0, 3.0, 7.0, 15.0, 22.5, 30.0, 45.0}) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double worst_m = 0.0;
    int phases = 0;
    for (double phase = 0.0; phase < 1.0; phase += 0.2, ++phases) {
      const Pose2 place{0.05 * phase, 0.03 * phase, radians(heading_deg)};
      Setting s(moved(test::rectangle(4.0, 3.0), place));
      const Pose2 truth = place * Pose2{1.7, 1.4, 0.3};
      Eigen::Vector3d here = Eigen::Vector3d::Zero();
      for (int i = 0; i < 10; ++i)
        here += error_of(s.match(s.see(truth, 0.01), truth).map_from_laser, truth) / 10.0;
      worst_m = std::max(worst_m, here.head<2>().norm());
      mean += here;
    }
    // A pose of one scan scatters by 0.6 mm along each axis, a mean of ten by 0.2 mm; a quarter of a cell
    // is 12.5.
    EXPECT_LT(worst_m, 1e-3) << heading_deg;
    EXPECT_LT(mean.head<2>().norm() / phases, 5e-4) << heading_deg;
  }
}

struct Corridor {
  FloorPlan plan{{{{-100, 0}, {100, 0}}, {{-100, 2.5}, {100, 2.5}}}};
  Pose2 truth{0.0, 1.0, 0.1};
  Pose2 guess{0.2, 1.05, 0.12};
};

/// How far a direction (m, m, rad) is from the x axis.
double tilt_deg(const Eigen::Vector3d& direction) {
  return degrees(std::acos(std::min(1.0, std::abs(direction.normalized().x()))));
}

TEST(Hector, InACorridorTheDirectionAlongItIsLeftAtTheGuess) {
  const Corridor c;
  Setting s = drawn(c.plan);
  for (const double sigma_m : {0.0, 0.01}) {
    const MatchResult match = s.match(s.see(c.truth, sigma_m), c.guess);
    EXPECT_EQ(match.rank, 2);
    EXPECT_LT(tilt_deg(match.weak_direction), sigma_m > 0.0 ? 0.5 : 0.1);
    EXPECT_NEAR(match.map_from_laser.x_m, c.guess.x_m, sigma_m > 0.0 ? 2e-3 : 1e-4);
    EXPECT_NEAR(match.map_from_laser.y_m, c.truth.y_m, 0.003);
    EXPECT_NEAR(match.map_from_laser.theta_rad, c.truth.theta_rad, 0.002);
    EXPECT_GT(match.covariance(0, 0), 1e4);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(match.covariance);
    EXPECT_LT(spread.eigenvalues()[1], 1e-3);
  }
}

TEST(Hector, TheRippleOfObliqueCellsDoesNotHoldACorridor) {
  // Along an oblique wall M goes up and down from cell to cell, and H has a tenth of its trace along the
  // axis.
  for (const double angle_rad : {0.0, 0.4, 1.0}) {
    const Corridor c;
    const Pose2 turn{0.0, 0.0, angle_rad};
    Setting s(moved(c.plan, turn));
    for (const double sigma_m : {0.0, 0.01})
      for (int i = 0; i < 10; ++i) {
        const Pose2 truth{c.truth.x_m + s.rng.uniform(), c.truth.y_m, c.truth.theta_rad};
        const Pose2 guess{truth.x_m + 0.1, truth.y_m + 0.04, truth.theta_rad + 0.02};
        const MatchResult match = s.match(s.see(turn * truth, sigma_m), turn * guess);
        const Pose2 found = turn.inverse() * match.map_from_laser;
        ASSERT_EQ(match.rank, 2);
        Eigen::Vector3d weak = match.weak_direction;
        weak.head<2>() = turn.rotation().transpose() * weak.head<2>();
        ASSERT_LT(tilt_deg(weak), sigma_m > 0.0 ? 1.0 : 0.1);
        ASSERT_NEAR(found.x_m, guess.x_m, sigma_m > 0.0 ? 3e-3 : 2e-4);
        ASSERT_NEAR(found.y_m, truth.y_m, 0.003);
        ASSERT_NEAR(found.theta_rad, truth.theta_rad, 0.002);
      }
  }
}

TEST(Hector, TheEndOfACorridorHoldsIt) {
  Corridor c;
  c.plan.walls.push_back({{6.0, 0.0}, {6.0, 2.5}});
  Setting s(c.plan);
  const MatchResult match = s.match(s.see(c.truth, 0.01), {0.06, 1.02, 0.11});
  EXPECT_EQ(match.rank, 3);
  EXPECT_NEAR(match.map_from_laser.x_m, c.truth.x_m, 0.01);
  EXPECT_GT(match.covariance(0, 0), match.covariance(1, 1));
}

TEST(Hector, InARoundRoomTheHeadingIsLeftAtTheGuess) {
  FloorPlan round{{{}}};
  for (int i = 0; i <= 360; ++i)
    round.walls.front().emplace_back(3.0 * std::cos(radians(i)), 3.0 * std::sin(radians(i)));
  Setting s(round);
  const MatchResult match = s.match(s.see({0.0, 0.0, 0.5}, 0.01), {0.05, -0.04, 0.52});
  EXPECT_EQ(match.rank, 2);
  EXPECT_GT(std::abs(match.weak_direction.z()), 0.9 * match.weak_direction.norm() / 3.0);
  EXPECT_NEAR(match.map_from_laser.theta_rad, 0.52, 1e-3);
  EXPECT_LT(match.map_from_laser.translation().norm(), 0.006);
}

/// How errors scatter beside what the covariances say: NEES, and the ratio of variances axis by axis.
struct Consistency {
  double nees = 0.0;
  Eigen::Vector3d scatter_over_told = Eigen::Vector3d::Zero();
};

Consistency consistency(Setting& s, double sigma_m, int runs) {
  Consistency found;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  Eigen::Vector3d told = Eigen::Vector3d::Zero();
  for (int i = 0; i < runs; ++i) {
    const Pose2 truth{s.rng.uniform(1.0, 5.0), s.rng.uniform(1.0, 3.0), s.rng.uniform(-3.0, 3.0)};
    const MatchResult match = s.match(s.see(truth, sigma_m), s.off(truth, 0.02, 0.01));
    const Eigen::Vector3d error = error_of(match.map_from_laser, truth);
    found.nees += error.dot(match.covariance.inverse() * error) / runs;
    squares += error.cwiseAbs2();
    told += match.covariance.diagonal();
  }
  found.scatter_over_told = squares.cwiseQuotient(told);
  return found;
}

TEST(Hector, ErrorsAreNoLargerThanTheCovarianceSaysAndNotMuchSmaller) {
  // Between a third and all of it: a beam on the flat top of a wall pulls on nothing and counts in no sum,
  // yet keeps the others from pulling far.
  Setting s(test::niche_room());
  const Consistency found = consistency(s, 0.01, 300);
  EXPECT_GT(found.nees, 1.0);
  EXPECT_LT(found.nees, 3.0 + 2.58 * std::sqrt(6.0 / 300));
  for (const int axis : {0, 1, 2}) {
    EXPECT_GT(found.scatter_over_told[axis], 0.25) << axis;
    EXPECT_LT(found.scatter_over_told[axis], 1.2) << axis;
  }
}

TEST(Hector, WhereWallsLieOnTheMiddlesOfDrawnCellsTheCovarianceIsThatOfTheNoise) {
  Setting s = drawn(test::rectangle(6.0, 5.0));
  s.pyramid.wall_sigma_m = 0.0;
  const Consistency found = consistency(s, 0.01, 300);
  EXPECT_NEAR(found.nees, 3.0, 0.3 + 2.58 * std::sqrt(6.0 / 300));
}

TEST(Hector, TheCovarianceIsInMetresAndRadians) {
  // Everything twice as large: variances of positions four times, those of headings as before.
  const auto covariance_at = [](double times) {
    FloorPlan plan = test::niche_room();
    for (auto& wall : plan.walls)
      for (auto& corner : wall) corner *= times;
    Setting s(plan, build_pyramid(plan, {.resolution_m = 0.05 * times}).value());
    s.config.sigma_m *= times;
    const Pose2 truth{3.0 * times, 2.0 * times, 0.4};
    return s.match(s.see(truth, 0.01 * times), truth).covariance;
  };
  const Eigen::Matrix3d once = covariance_at(1.0);
  const Eigen::Matrix3d twice = covariance_at(2.0);
  EXPECT_NEAR(twice(0, 0), 4.0 * once(0, 0), 0.4 * once(0, 0));
  EXPECT_NEAR(twice(1, 1), 4.0 * once(1, 1), 0.4 * once(1, 1));
  EXPECT_NEAR(twice(2, 2), once(2, 2), 0.1 * once(2, 2));
}

TEST(Hector, AThirdOfTheBeamsOnPeopleDoesNotMoveThePose) {
  Setting s(test::niche_room());
  const Pose2 truth{3.0, 2.0, 0.4};
  for (int i = 0; i < 20; ++i) {
    auto points = s.see(truth, 0.01);
    const auto begin = static_cast<std::size_t>(s.rng.uniform(0.0, 300.0));
    for (std::size_t k = begin; k < begin + 180; ++k) points[k] = points[k].normalized() * 0.9;
    for (std::size_t k = begin + 400; k < begin + 580; ++k) points[k] = points[k].normalized() * 1.1;
    const MatchResult match = s.match(points, s.off(truth, 0.02, 0.01));
    EXPECT_LT(distance_m(match.map_from_laser, truth), 0.006);
    EXPECT_LT(match.on_map_ratio, 0.75);
    EXPECT_GT(match.misfit, 0.25);
  }
}

TEST(Hector, OnTheMapMeansWhatItMeansToIcp) {
  Setting s(test::niche_room());
  const WallIndex index(s.plan);
  IcpScratch scratch;
  const Pose2 truth{3.0, 2.0, 0.4};
  for (const double share : {0.0, 0.2, 0.5}) {
    auto points = s.see(truth, 0.01);
    for (std::size_t k = 0; static_cast<double>(k) < share * static_cast<double>(points.size()); ++k)
      points[k] *= 0.8;
    const MatchResult hector = s.match(points, truth);
    const MatchResult icp = match_icp(points, index, truth, {}, scratch);
    EXPECT_NEAR(hector.on_map_ratio, icp.on_map_ratio, 0.03);
    EXPECT_NEAR(hector.misfit, icp.misfit, 0.05);
  }
}

TEST(Hector, StoppingEarlySavesStepsAndChangesNothing) {
  Setting s = drawn(test::niche_room(), {.heading_rad = 0.35});
  const Pose2 truth{3.0, 2.0, 0.4};
  const auto points = s.see(truth, 0.01);
  const MatchResult all = s.match(points, {3.01, 1.99, 0.405});
  s.config.stops_early = true;
  const MatchResult early = s.match(points, {3.01, 1.99, 0.405});
  EXPECT_EQ(early.status, MatchStatus::converged);
  EXPECT_LT(early.iterations, all.iterations);
  EXPECT_LT(distance_m(early.map_from_laser, all.map_from_laser), 2.0 * s.config.converged_m);
}

TEST(Hector, AStepIsNoLongerThanAllowed) {
  Setting s(test::niche_room());
  s.config.coarse_iterations = 0;
  s.config.fine_iterations = 1;
  s.config.max_step_cells = 0.1;
  s.config.max_turn_rad = 0.001;
  const Pose2 truth{3.0, 2.0, 0.4};
  const Pose2 guess{3.04, 1.97, 0.42};
  const MatchResult match = s.match(s.see(truth), guess);
  EXPECT_LE(distance_m(match.map_from_laser, guess), 0.1 * 0.05 + 1e-9);
  EXPECT_LE(heading_difference_rad(match.map_from_laser, guess), 0.001 + 1e-9);
  EXPECT_EQ(match.status, MatchStatus::max_iterations);
}

TEST(Hector, TooLittleToHoldOnToLeavesTheGuess) {
  Setting s(test::niche_room());
  const Pose2 guess{1.0, 2.0, 0.3};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Points& points : {Points{}, Points{{0.5, 0.1}}, Points(50, {500, 500}), Points(50, {nan, 1.0}),
                               Points(50, {0.3, 0.1})}) {
    const MatchResult match = s.match(points, guess);
    EXPECT_EQ(match.status, MatchStatus::too_few_pairs);
    EXPECT_FALSE(match.usable());
    EXPECT_EQ(match.map_from_laser, guess);
    EXPECT_TRUE(match.covariance.allFinite());
  }
}

TEST(Hector, AMapWithoutObstaclesOrLevelsLeavesTheGuess) {
  Setting s(test::niche_room());
  const auto points = s.see({3.0, 2.0, 0.4});
  const Pose2 guess{3.0, 2.0, 0.4};
  OccupancyGrid free = rasterize(s.plan).value();
  std::fill(free.occupancy_percent.begin(), free.occupancy_percent.end(), OccupancyGrid::kFree);
  OccupancyPyramid blank;
  blank.levels.assign(3, OccupancyLevel(0.05, {}));
  for (const OccupancyPyramid& map : {OccupancyPyramid{}, blank, build_pyramid(free).value()}) {
    s.pyramid = map;
    const MatchResult match = s.match(points, guess);
    EXPECT_EQ(match.status, MatchStatus::too_few_pairs);
    EXPECT_EQ(match.map_from_laser, guess);
  }
}

TEST(Hector, NoGuessIsTooFarOrTooStrangeForAFiniteAnswer) {
  Setting s(test::niche_room());
  const auto points = s.see({3.0, 2.0, 0.4});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Pose2& guess : {Pose2{nan, 0.0, 0.0}, Pose2{0.0, 0.0, nan}, Pose2{1e300, 0.0, 0.0},
                             Pose2{0.0, -1e9, 0.0}, Pose2{1e5, 1e5, 1e9}}) {
    const MatchResult match = s.match(points, guess);
    EXPECT_EQ(match.status, MatchStatus::too_few_pairs);
    EXPECT_TRUE(match.map_from_laser.is_finite());
    EXPECT_TRUE(match.covariance.allFinite());
  }
}

TEST(Hector, AllPointsInOnePlaceGiveNoHeadingAndNoNonsense) {
  Setting s(test::niche_room());
  const MatchResult match = s.match(Points(100, {1.0, 0.0}), {1.0, 3.98, 1.57});
  EXPECT_LT(match.rank, 3);
  EXPECT_TRUE(match.map_from_laser.is_finite());
  EXPECT_TRUE(match.covariance.allFinite());
}

}  // namespace
}  // namespace beaconless
