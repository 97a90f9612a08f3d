// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "beaconless/particle/gaussian_motion.hpp"
#include "beaconless/particle/odometry_motion.hpp"

namespace beaconless {
namespace {

constexpr int kMany = 200'000;

struct Moments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Moments moments_of(const Particles& particles) {
  Moments of;
  const auto count = static_cast<double>(particles.size());
  const auto value = [&](std::size_t i) {
    return Eigen::Vector3d(particles.x_m[i], particles.y_m[i], particles.theta_rad[i]);
  };
  for (std::size_t i = 0; i < particles.size(); ++i) of.mean += value(i) / count;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector3d off = value(i) - of.mean;
    of.covariance += off * off.transpose() / count;
  }
  return of;
}

Particles many_at(const Pose2& pose) {
  Particles particles;
  for (int i = 0; i < kMany; ++i) particles.add(pose, 1.0 / kMany);
  return particles;
}

/// Alphas all different, so that none can stand for another.
AmclConfig distinct(OdometryModel model) {
  AmclConfig config;
  config.odom_model_type = model;
  config.odom_alpha1 = 0.004;
  config.odom_alpha2 = 0.002;
  config.odom_alpha3 = 0.003;
  config.odom_alpha4 = 0.001;
  config.odom_alpha5 = 0.005;
  return config;
}

TEST(OdometryMotion, PartsHaveTheVariancesOfTheFormula) {
  const double way = std::hypot(0.4, 0.3);
  const double turn1 = std::atan2(0.3, 0.4);
  const double turn2 = 0.9 - turn1;
  const OdometryStep step = odometry_step({0.4, 0.3, 0.9}, distinct(OdometryModel::diff_corrected));
  EXPECT_NEAR(step.turn1_rad, turn1, 1e-12);
  EXPECT_NEAR(step.way_m, way, 1e-12);
  EXPECT_NEAR(step.turn2_rad, turn2, 1e-12);
  EXPECT_NEAR(std::pow(step.turn1_sigma_rad, 2), 0.004 * turn1 * turn1 + 0.002 * way * way, 1e-12);
  EXPECT_NEAR(std::pow(step.way_sigma_m, 2), 0.003 * way * way + 0.001 * (turn1 * turn1 + turn2 * turn2),
              1e-12);
  EXPECT_NEAR(std::pow(step.turn2_sigma_rad, 2), 0.004 * turn2 * turn2 + 0.002 * way * way, 1e-12);
  EXPECT_EQ(step.side_sigma_m, 0.0);
}

TEST(OdometryMotion, TheKeptBugTakesVariancesForDeviations) {
  for (const auto& [kept, corrected] : {std::pair{OdometryModel::diff, OdometryModel::diff_corrected},
                                        {OdometryModel::omni, OdometryModel::omni_corrected}}) {
    const OdometryStep bug = odometry_step({0.4, 0.3, 0.9}, distinct(kept));
    const OdometryStep right = odometry_step({0.4, 0.3, 0.9}, distinct(corrected));
    EXPECT_NEAR(bug.way_sigma_m, right.way_sigma_m * right.way_sigma_m, 1e-12);
    EXPECT_NEAR(bug.turn2_sigma_rad, right.turn2_sigma_rad * right.turn2_sigma_rad, 1e-12);
    EXPECT_NEAR(bug.side_sigma_m, right.side_sigma_m * right.side_sigma_m, 1e-12);
  }
}

TEST(OdometryMotion, BackwardsIsAsSureAsForwards) {
  const AmclConfig config = distinct(OdometryModel::diff_corrected);
  const OdometryStep ahead = odometry_step({0.5, 0.1, 0.2}, config);
  const OdometryStep back = odometry_step({-0.5, -0.1, 0.2}, config);
  EXPECT_NEAR(back.way_m, -ahead.way_m, 1e-12);
  EXPECT_NEAR(back.turn1_rad, ahead.turn1_rad, 1e-12);
  EXPECT_NEAR(back.turn1_sigma_rad, ahead.turn1_sigma_rad, 1e-12);
  EXPECT_NEAR(back.way_sigma_m, ahead.way_sigma_m, 1e-12);
  EXPECT_NEAR(back.turn2_sigma_rad, ahead.turn2_sigma_rad, 1e-12);
}

class EachOdometry : public testing::TestWithParam<OdometryModel> {};

TEST_P(EachOdometry, MovesACloudByItsMeanAndCovariance) {
  const Pose2 begin{3, -2, 0.7};
  for (const Pose2& motion : {Pose2{0.4, 0.05, 0.3}, Pose2{-0.4, -0.05, 0.2}, Pose2{0, 0, -0.5}, Pose2{}}) {
    const OdometryStep step = odometry_step(motion, distinct(GetParam()));
    Particles particles = many_at(begin);
    Rng rng(5);
    move_by_odometry(step, rng, particles);
    const Moments seen = moments_of(particles);
    const Pose2 end = begin * motion;
    const Eigen::Matrix3d expected = moved_by_odometry(Eigen::Matrix3d::Zero(), begin, step);
    EXPECT_NEAR((seen.mean - Eigen::Vector3d(end.x_m, end.y_m, end.theta_rad)).norm(), 0.0, 2e-3) << motion;
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(seen.covariance(i), expected(i), 0.03 * expected.diagonal().maxCoeff() + 1e-15)
          << motion << " element " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EachOdometry,
                         testing::Values(OdometryModel::diff, OdometryModel::diff_corrected,
                                         OdometryModel::omni, OdometryModel::omni_corrected));

TEST(OdometryMotion, CarriesTheCovarianceOfTheBeginning) {
  Eigen::Matrix3d before = Eigen::Vector3d(0.01, 0.02, 0.001).asDiagonal();
  before(0, 1) = before(1, 0) = 0.005;
  const Pose2 begin{0, 0, -0.4};
  AmclConfig still;
  still.odom_alpha1 = still.odom_alpha2 = still.odom_alpha3 = still.odom_alpha4 = 0.0;
  const Pose2 motion{1.0, 0.2, 0.3};
  const Eigen::Matrix3d after = moved_by_odometry(before, begin, odometry_step(motion, still));
  EXPECT_LT((after - moved_covariance(before, begin, motion)).norm(), 1e-12);
}

TEST(GaussianMotion, HasTheMomentsOfItsCovariance) {
  Eigen::Matrix3d covariance;
  covariance << 4e-4, 1e-4, 0, 1e-4, 9e-4, 2e-4, 0, 2e-4, 1e-4;
  Particles particles = many_at({1, 2, 0});
  Rng rng(6);
  move_by_gaussian({0.1, 0.02, 0.05}, covariance, rng, particles);
  const Moments seen = moments_of(particles);
  EXPECT_LT((seen.mean - Eigen::Vector3d(1.1, 2.02, 0.05)).norm(), 3e-4);
  EXPECT_LT((seen.covariance - covariance).norm(), 0.02 * covariance.norm());
}

TEST(GaussianMotion, IsInTheAxesOfTheBase) {
  const Eigen::Matrix3d ahead = Eigen::Vector3d(1e-2, 0, 0).asDiagonal();
  Particles particles = many_at({0, 0, kPi / 2});
  Rng rng(7);
  move_by_gaussian({0.3, 0, 0}, ahead, rng, particles);
  const Moments seen = moments_of(particles);
  EXPECT_NEAR(seen.mean.y(), 0.3, 2e-3);
  EXPECT_LT(seen.covariance(0, 0), 1e-12);
  EXPECT_NEAR(seen.covariance(1, 1), 1e-2, 3e-4);
}

}  // namespace
}  // namespace beaconless
