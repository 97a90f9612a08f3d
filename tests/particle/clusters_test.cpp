// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/clusters.hpp"

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/particle/free_space.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

void add_around(const Pose2& pose, double sigma, int count, double weight, Rng& rng, Particles& particles) {
  for (int i = 0; i < count; ++i)
    particles.add({pose.x_m + rng.normal(sigma), pose.y_m + rng.normal(sigma),
                   wrap_angle(pose.theta_rad + rng.normal(sigma))},
                  weight / count);
}

TEST(Clusters, HaveTheMeansAndWeightsOfTheirParticles) {
  Rng rng(1);
  Particles particles;
  add_around({2, 1, kPi - 0.02}, 0.05, 500, 0.7, rng, particles);  // on both sides of half a turn
  add_around({-3, 4, 0.3}, 0.03, 500, 0.3, rng, particles);
  ClusterFinder finder;
  const auto clusters = finder.find(particles);
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_NEAR(clusters[0].weight, 0.7, 1e-12);
  EXPECT_NEAR(clusters[1].weight, 0.3, 1e-12);
  EXPECT_NEAR(distance_m(clusters[0].mean, {2, 1, 0}), 0.0, 0.01);
  EXPECT_LT(heading_difference_rad(clusters[0].mean, {0, 0, kPi - 0.02}), 0.01);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(clusters[0].covariance(i, i), 0.0025, 5e-4) << i;
    EXPECT_NEAR(clusters[1].covariance(i, i), 0.0009, 2e-4) << i;
  }
  // Either may be it: as wide as the way to the other.
  const Eigen::Matrix3d spread = spread_around(clusters[0].mean, clusters);
  EXPECT_NEAR(spread(0, 0), 0.3 * 25.0, 0.1);
  EXPECT_NEAR(spread(0, 1), -0.3 * 15.0, 0.1);
}

TEST(Clusters, AreOneWhereBinsTouch) {
  Particles particles;
  for (int i = 0; i < 40; ++i) particles.add({0.2 * i, 0.0, 0.0}, 1.0 / 40);
  ClusterFinder finder;
  EXPECT_EQ(finder.find(particles).size(), 1U);
  particles.add({20.0, 0.0, 0.0}, 0.0);
  EXPECT_EQ(finder.find(particles).size(), 2U);
}

TEST(FreeSpace, OfAPlanIsWhatItsWallsShutIn) {
  const FreeSpace space{Map(test::niche_room())};
  EXPECT_NEAR(space.area_m2(), 31.5, 3.0);
  Rng rng(2);
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose = space.sample(rng);
    const bool is_in = pose.x_m > 0 && pose.y_m > 0 && pose.y_m < 5 && pose.x_m < 7.5 &&
                       (pose.x_m < 6 || (pose.y_m > 2 && pose.y_m < 3.2));
    EXPECT_TRUE(is_in) << pose;
  }
}

TEST(FreeSpace, OfAnOpenPlanIsTheBoxAroundIt) {
  const FreeSpace space{Map(FloorPlan{{{{0, 0}, {10, 0}}, {{0, 3}, {10, 3}}}})};
  EXPECT_GT(space.area_m2(), 25.0);
}

TEST(FreeSpace, WithinADiscStaysThere) {
  const FreeSpace part = FreeSpace(Map(test::niche_room())).within({1, 1}, 0.8);
  Rng rng(3);
  double mean = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose = part.sample(rng);
    EXPECT_LT(distance_m(pose, {1, 1, 0}), 0.9);
    mean += pose.theta_rad / 2000;
  }
  EXPECT_NEAR(mean, 0.0, 0.15);
  // Where nothing is free, the disc itself.
  const FreeSpace outside = FreeSpace(Map(test::niche_room())).within({50, 50}, 0.5);
  for (int i = 0; i < 100; ++i) EXPECT_LT(distance_m(outside.sample(rng), {50, 50, 0}), 0.5 + 1e-9);
}

}  // namespace
}  // namespace beaconless
