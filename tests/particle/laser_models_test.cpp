// SPDX-License-Identifier: Apache-2.0
// The fast models against slow twins that know nothing of them.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/map/rasterize.hpp"
#include "beaconless/particle/beam_model.hpp"
#include "beaconless/particle/beam_skip.hpp"
#include "beaconless/particle/field_sums.hpp"
#include "beaconless/particle/laser_weights.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

Map room(bool is_grid) {
  const FloorPlan plan = test::niche_room();
  return is_grid ? Map(rasterize(plan, {.resolution_m = 0.05}).value()) : Map(plan);
}

Particles scattered(Rng& rng, std::size_t count) {
  Particles particles;
  for (std::size_t i = 0; i < count; ++i)
    particles.add({rng.uniform(-1, 8), rng.uniform(-1, 6), rng.uniform(-kPi, kPi)},
                  1.0 / static_cast<double>(count));
  return particles;
}

Scan scan_at(const Pose2& pose, Rng& rng) {
  return Scan::make(test::sweep(RayCaster(test::niche_room().segments()), pose, 0.01, rng)).value();
}

class EachMap : public testing::TestWithParam<bool> {};  // a grid

/// log p of a beam's end by its distance to the nearest surface, beam by beam.
TEST_P(EachMap, FieldIsTheSumOfLogsByTheDistanceToTheNearestSurface) {
  const Map map = room(GetParam());
  AmclConfig config;
  config.laser_field_cell = 0.02;
  const SurfaceMap surfaces = build_surface_map(map, config.laser_likelihood_max_dist).value();
  const Pose2 base_from_laser{0.3, 0.1, 0.4};
  LaserWeights weights(map, surfaces, base_from_laser, config);
  Rng rng(1);
  const Scan scan = scan_at({3, 2, 0.3}, rng);
  const auto points = test::points_of(scan);
  const Particles particles = scattered(rng, 300);
  std::vector<double> logs;
  ASSERT_EQ(weights.weigh(particles, scan, points, false, logs), 60U);

  BeamEnds ends;
  choose_ends(points, 60, ends);
  double off = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    double slow = 0.0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const Eigen::Vector2d end =
          particles.pose(i) * base_from_laser *
          Eigen::Vector2d(static_cast<double>(ends.x_m[k]), static_cast<double>(ends.y_m[k]));
      const auto surface = std::visit([&](const auto& index) { return index.nearest(end); }, surfaces);
      const double d = surface ? std::min(surface->distance_m, 2.0) : 2.0;
      slow += std::log(0.95 * std::exp(-d * d / (2 * 0.2 * 0.2)) + 0.05 / 30.0);
    }
    // Half a diagonal of a cell at the steepest place of log p, and half a step of a byte.
    EXPECT_NEAR(logs[i], slow, 60 * 0.12) << i;
    off += (logs[i] - slow) / static_cast<double>(particles.size());
  }
  EXPECT_NEAR(off, 0.0, 0.5) << "a bias";
}

TEST_P(EachMap, CubesAddUpToOneAndMore) {
  const Map map = room(GetParam());
  AmclConfig config;
  config.laser_model_type = LaserModel::likelihood_field;
  const SurfaceMap surfaces = build_surface_map(map, config.laser_likelihood_max_dist).value();
  LaserWeights weights(map, surfaces, {}, config);
  Rng rng(2);
  const Scan scan = scan_at({3, 2, 0.3}, rng);
  Particles particles;
  particles.add({3, 2, 0.3}, 0.5);
  particles.add({300, 2, 0.3}, 0.5);
  std::vector<double> logs;
  weights.weigh(particles, scan, test::points_of(scan), false, logs);
  EXPECT_NEAR(std::exp(logs[0]), 1.0 + 60 * std::pow(0.95 + 0.05 / 30.0, 3), 3.0);
  EXPECT_NEAR(std::exp(logs[1]), 1.0, 1e-6);
}

TEST_P(EachMap, WideLanesGiveTheSame) {
  if (!has_wide_lanes()) GTEST_SKIP() << "this processor has none";
  const SurfaceMap surfaces = build_surface_map(room(GetParam()), 2.0).value();
  const LikelihoodField field(surfaces, {});
  Rng rng(3);
  const auto points = test::points_of(scan_at({3, 2, 0.3}, rng));
  Particles particles = scattered(rng, 500);
  particles.add({1e300, 0, 0}, 0.0);
  particles.add({0, -1e18, 0}, 0.0);
  for (const int beams : {1, 7, 60, 200}) {
    BeamEnds ends;
    choose_ends(points, beams, ends);
    std::vector<std::int32_t> wide;
    std::vector<std::int32_t> portable;
    sum_field(particles, {0.1, 0, 0.2}, ends, field, wide, true);
    sum_field(particles, {0.1, 0, 0.2}, ends, field, portable, false);
    std::size_t other = 0;
    for (std::size_t i = 0; i < wide.size(); ++i) other += wide[i] != portable[i] ? 1 : 0;
    EXPECT_LE(other, 5U) << "ends that rounding puts into the next cell";
    EXPECT_EQ(wide[500], 0);
    EXPECT_EQ(wide[501], 0);
  }
}

/// The walls of a grid stop rays at the borders of its cells, those of a plan where they are.
TEST_P(EachMap, RaysEndAtTheFirstWall) {
  const Map map = room(GetParam());
  const RayCaster walls(ray_walls_of(map));
  const RayCaster exact(test::niche_room().segments());
  const auto* grid = std::get_if<OccupancyGrid>(&map);
  Rng rng(4);
  for (int i = 0; i < 500; ++i) {
    const double angle = rng.uniform(-kPi, kPi);
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d from(rng.uniform(2.7, 5.5), rng.uniform(0.5, 3.0));
    const auto hit = walls.cast(from, along, 30.0);
    ASSERT_TRUE(hit.has_value());
    if (grid == nullptr) {
      EXPECT_NEAR(hit->range_m, exact.cast(from, along, 30.0)->range_m, 1e-9);
      continue;
    }
    const auto is_wall = [&](double range_m) {
      return grid->is_occupied(grid->cell_at(from + range_m * along));
    };
    EXPECT_TRUE(is_wall(hit->range_m + 1e-6)) << i;
    for (double range_m = 0.0; range_m < hit->range_m - 1e-6; range_m += 0.003)
      ASSERT_FALSE(is_wall(range_m)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, EachMap, testing::Bool(),
                         [](const auto& is_grid) { return is_grid.param ? "grid" : "plan"; });

/// The density of a beam over all ranges, and the chance of no return, make a whole.
TEST(BeamModel, IsADensity) {
  AmclConfig config;
  config.laser_z_hit = 0.7;
  config.laser_z_short = 0.1;
  config.laser_z_max = 0.05;
  config.laser_z_rand = 0.15;
  const BeamModel model(test::niche_room(), config);
  for (const double expected_m : {0.3, 4.0, 29.5}) {
    double sum = 0.0;
    constexpr double kStep_m = 1e-3;
    for (double z = 0.5 * kStep_m; z < 30.0; z += kStep_m)
      sum += kStep_m * std::exp(model.log_likelihood({{1, 0}, z, true}, expected_m));
    sum += std::exp(model.log_likelihood({{1, 0}, 30.0, false}, expected_m));
    EXPECT_NEAR(sum, 1.0, 2e-3) << expected_m;
  }
}

TEST(BeamModel, AddsUpWhatItsBeamsSay) {
  const AmclConfig config;
  const BeamModel model(test::niche_room(), config);
  const RayCaster walls(test::niche_room().segments());
  Rng rng(5);
  std::vector<CastBeam> beams;
  choose_beams(scan_at({3, 2, 0.3}, rng), 20, 30.0, beams);
  const Pose2 base_from_laser{0.2, 0.1, -0.5};
  const Particles particles = scattered(rng, 50);
  std::vector<double> sums;
  model.sum(particles, base_from_laser, beams, sums);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Pose2 laser = particles.pose(i) * base_from_laser;
    double slow = 0.0;
    for (const CastBeam& beam : beams) {
      const double angle = laser.theta_rad + std::atan2(beam.direction.y(), beam.direction.x());
      const auto hit = walls.cast(laser.translation(), {std::cos(angle), std::sin(angle)}, 30.0);
      slow += model.log_likelihood(beam, hit ? hit->range_m : 100.0);
    }
    EXPECT_NEAR(sums[i], slow, 1e-6);
  }
}

TEST(LaserBeams, AreAllWhereThereAreNoMoreThanAskedFor) {
  RawScan raw{.angle_min_rad = 0.0F, .angle_increment_rad = 0.1F, .range_max_m = 10.0F};
  raw.ranges_m = {1.0F, std::numeric_limits<float>::quiet_NaN(), 2.0F, std::numeric_limits<float>::infinity(),
                  3.0F};
  const Scan scan = Scan::make(raw).value();
  std::vector<CastBeam> beams;
  choose_beams(scan, 30, 10.0, beams);
  ASSERT_EQ(beams.size(), 4U) << "those that hit, and the one that found the way free";
  EXPECT_FALSE(beams[2].is_hit);
  EXPECT_EQ(beams[2].range_m, 10.0);
  choose_beams(scan, 2, 10.0, beams);
  EXPECT_EQ(beams.size(), 2U);
  BeamEnds ends;
  choose_ends(test::points_of(scan), 30, ends);
  EXPECT_EQ(ends.size(), 3U);
  choose_ends({}, 30, ends);
  EXPECT_EQ(ends.size(), 0U);
}

TEST(LaserBeams, AreSpreadEvenly) {
  Rng rng(6);
  const auto points = test::points_of(scan_at({3, 2, 0.3}, rng));
  BeamEnds ends;
  choose_ends(points, 60, ends);
  ASSERT_EQ(ends.size(), 60U);
  std::size_t last = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    const std::size_t place = (2 * i + 1) * points.size() / 120;
    EXPECT_EQ(ends.x_m[i], static_cast<float>(points[place].x()));
    if (i > 0) {
      EXPECT_NEAR(static_cast<double>(place - last), static_cast<double>(points.size()) / 60, 1.0);
    }
    last = place;
  }
}

TEST(BeamSkip, LeavesOutWhatFewParticlesExplainAndNeverAll) {
  const SurfaceMap surfaces = build_surface_map(test::niche_room(), 2.0).value();
  const AmclConfig config;
  const LikelihoodField field(surfaces, config);
  Particles particles;
  for (int i = 0; i < 20; ++i) particles.add({3.0 + 0.005 * i, 2.0, 0.0}, 0.05);
  // Two ends on walls, and one in the middle of the room.
  BeamEnds ends{{3.0F, 0.0F, 1.0F}, {-1.0F, -2.0F, 0.0F}};
  skip_beams(particles, {}, field, config, ends);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_EQ(ends.y_m[0] + ends.y_m[1], -3.0F);
  BeamEnds nowhere{{1.0F, 1.1F}, {0.0F, 0.0F}};
  skip_beams(particles, {}, field, config, nowhere);
  EXPECT_EQ(nowhere.size(), 2U) << "where nothing would be left all are kept";
}

}  // namespace
}  // namespace beaconless
