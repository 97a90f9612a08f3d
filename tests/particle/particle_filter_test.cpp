// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/particle_filter.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

const Pose2 kTruth{3.0, 2.0, 0.3};
const Eigen::Matrix3d kAround = Eigen::Vector3d(0.01, 0.01, 0.004).asDiagonal();

struct Room {
  explicit Room(const AmclConfig& config, double sigma_m = 0.01)
      : surfaces(build_surface_map(plan, config.laser_likelihood_max_dist).value()),
        filter(plan, surfaces, {}, config),
        sigma_m_(sigma_m) {}

  bool weigh(const Pose2& truth = kTruth) {
    const Scan scan = Scan::make(test::sweep(walls, truth, sigma_m_, rng)).value();
    return filter.weigh(scan, test::points_of(scan));
  }

  FloorPlan plan = test::niche_room();
  RayCaster walls{plan.segments()};
  SurfaceMap surfaces;
  ParticleFilter filter;
  Rng rng{11};

 private:
  double sigma_m_;
};

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(ParticleFilter, WeightsAlwaysAddUpToOne) {
  Room room({});
  room.filter.start_at(kTruth, kAround);
  for (int i = 0; i < 20; ++i) {
    room.filter.move({0, 0, 0}, 1e-5 * Eigen::Matrix3d::Identity());
    ASSERT_TRUE(room.weigh());
    ASSERT_NEAR(sum_of(room.filter.particles().weight), 1.0, 1e-9);
    room.filter.resample(true);
    ASSERT_NEAR(sum_of(room.filter.particles().weight), 1.0, 1e-9);
  }
  room.filter.start_anywhere();
  ASSERT_TRUE(room.weigh());
  EXPECT_NEAR(sum_of(room.filter.particles().weight), 1.0, 1e-9);
}

/// With a perfect map and scan and the true pose in the cloud, the mean comes to the truth as one over the
/// root of how many particles there are.
TEST(ParticleFilter, TheMeanComesToTheTruthByTheRootOfTheCount) {
  constexpr int kRuns = 60;
  const auto rmse_m = [](int count) {
    double squares = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      AmclConfig config;
      config.seed = run;
      config.min_particles = config.max_particles = count;
      config.laser_field_cell = 0.02;
      config.laser_max_beams = 360;
      config.least_effective_ratio = 0.0;
      Room room(config, 0.0);
      room.filter.start_at(kTruth, kAround);
      room.weigh();
      squares += std::pow(distance_m(room.filter.clusters().front().mean, kTruth), 2) / kRuns;
    }
    return std::sqrt(squares);
  };
  const double few_m = rmse_m(50);
  const double many_m = rmse_m(1250);
  EXPECT_LT(many_m, 0.005);
  EXPECT_NEAR(few_m / many_m, 5.0, 1.5) << few_m << " " << many_m;
}

TEST(ParticleFilter, DrawsAsManyAsTheBinsAskFor) {
  AmclConfig config;
  config.min_particles = 100;
  config.max_particles = 4000;
  config.selective_resampling = false;
  Room room(config);
  room.filter.start_at(kTruth, kAround);
  EXPECT_EQ(room.filter.particles().size(), 4000U);
  for (int i = 0; i < 5; ++i) {
    room.weigh();
    room.filter.resample(true);
  }
  EXPECT_GE(room.filter.particles().size(), 100U);
  EXPECT_LT(room.filter.particles().size(), 400U) << "a narrow cloud lies in a few bins";
  room.filter.start_anywhere();
  room.weigh();
  room.filter.resample(true);
  EXPECT_GT(room.filter.particles().size(), 1000U) << "one all over the room in many";
}

TEST(ParticleFilter, WithoutABeamNothingChanges) {
  Room room({});
  room.filter.start_at(kTruth, kAround);
  const Particles before = room.filter.particles();
  RawScan raw = test::sweep(room.walls, kTruth, 0.01, room.rng);
  for (float& range : raw.ranges_m) range = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(room.filter.weigh(Scan::make(raw).value(), {}));
  EXPECT_EQ(room.filter.particles(), before);
}

TEST(ParticleFilter, TheSameSeedGivesTheSameBits) {
  const auto cloud = [](int seed) {
    AmclConfig config;
    config.seed = seed;
    Room room(config);
    room.filter.start_at(kTruth, kAround);
    for (int i = 0; i < 5; ++i) {
      room.filter.move(odometry_step({0.1, 0, 0.05}, config));
      room.weigh(kTruth);
      room.filter.resample(true);
    }
    return room.filter.particles();
  };
  EXPECT_EQ(cloud(1), cloud(1));
  EXPECT_NE(cloud(1), cloud(2));
}

TEST(ParticleFilter, AllocatesNothingAfterItsFirstScan) {
  for (const LaserModel model :
       {LaserModel::likelihood_field, LaserModel::likelihood_field_prob, LaserModel::beam}) {
    AmclConfig config;
    config.laser_model_type = model;
    config.max_particles = 1000;
    Room room(config);
    room.filter.start_anywhere();
    const Scan scan = Scan::make(test::sweep(room.walls, kTruth, 0.01, room.rng)).value();
    const auto points = test::points_of(scan);
    room.filter.weigh(scan, points);
    const std::size_t before = test::allocations();
    ASSERT_GT(before, 0U) << "the counter does not count";
    for (int i = 0; i < 10; ++i) {
      room.filter.move(odometry_step({0.1, 0, 0.05}, config));
      room.filter.weigh(scan, points);
      room.filter.resample(true);
    }
    EXPECT_EQ(test::allocations(), before) << static_cast<int>(model);
  }
}

TEST(MeanWeights, TellALostRobotFromAnotherDay) {
  MeanWeights means(0.001, 0.1);
  EXPECT_EQ(means.lost_share(), 0.0);
  for (int i = 0; i < 200; ++i) {
    means.add(0.8 + (i % 2 == 0 ? 0.05 : -0.05));
    EXPECT_EQ(means.lost_share(), 0.0) << i;
  }
  for (int i = 0; i < 40; ++i) means.add(0.2);
  EXPECT_NEAR(means.lost_share(), 1.0 - means.fast() / (MeanWeights::kUsual * means.slow()), 1e-12);
  EXPECT_GT(means.lost_share(), 0.6);
  for (int i = 0; i < 60; ++i) means.add(0.8);
  EXPECT_EQ(means.lost_share(), 0.0);
  MeanWeights off(0.0, 0.0);
  off.add(0.9);
  off.add(0.1);
  EXPECT_EQ(off.lost_share(), 0.0);
}

/// A cloud in the wrong place is put all over the room, and found in the right one.
TEST(ParticleFilter, PutsParticlesAnywhereOnceScansFitWorse) {
  AmclConfig config;
  config.max_particles = 3000;
  Room room(config);
  room.filter.start_at(kTruth, kAround);
  const auto see = [&](const Pose2& truth) {
    room.filter.move({}, 1e-4 * Eigen::Matrix3d::Identity());
    room.weigh(truth);
    room.filter.resample(true);
  };
  for (int i = 0; i < 60; ++i) {
    see(kTruth);
    ASSERT_EQ(room.filter.lost_share(), 0.0) << i;
  }
  const Pose2 elsewhere{5.0, 4.0, -2.5};
  bool is_found = false;
  double most = 0.0;
  for (int i = 0; i < 200 && !is_found; ++i) {
    see(elsewhere);
    most = std::max(most, room.filter.lost_share());
    is_found = distance_m(room.filter.clusters().front().mean, elsewhere) < 0.1;
  }
  EXPECT_TRUE(is_found);
  EXPECT_GT(most, 0.1);
}

}  // namespace
}  // namespace beaconless
