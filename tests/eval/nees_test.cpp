// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/nees.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/eval/chi_square.hpp"

namespace beaconless::eval {
namespace {

TEST(ChiSquare, TwoDegreesOfFreedomHaveAClosedForm) {
  for (const double value : {1e-6, 0.1, 1.0, 2.0, 4.0, 10.0, 60.0})
    EXPECT_NEAR(chi_square_probability(value, 2.0), 1.0 - std::exp(-0.5 * value), 1e-13);
  for (const double p : {0.025, 0.5, 0.95, 0.999})
    EXPECT_NEAR(chi_square_quantile(p, 2.0), -2.0 * std::log(1.0 - p), 1e-10);
}

TEST(ChiSquare, OneAndThreeDegreesOfFreedomHaveTheErrorFunction) {
  for (const double value : {1e-3, 0.5, 2.0, 3.84, 7.81, 20.0}) {
    const double one = std::erf(std::sqrt(0.5 * value));
    EXPECT_NEAR(chi_square_probability(value, 1.0), one, 1e-13);
    const double three = one - std::sqrt(2.0 * value / std::acos(-1.0)) * std::exp(-0.5 * value);
    EXPECT_NEAR(chi_square_probability(value, 3.0), three, 1e-13);
  }
}

TEST(ChiSquare, GatesThatEverybodyKnows) {
  EXPECT_NEAR(chi_square_quantile(0.95, 3.0), 7.815, 5e-4);
  EXPECT_NEAR(chi_square_quantile(0.99, 3.0), 11.345, 5e-4);
}

TEST(ChiSquare, ManyDegreesOfFreedomApproachWilsonAndHilferty) {
  // Their cube is off by less than 1e-5 of the value here.
  for (const double dof : {1000.0, 30000.0, 1e6}) {
    for (const auto& [p, z] : {std::pair{0.025, -1.959963985}, {0.5, 0.0}, {0.975, 1.959963985}}) {
      const double cube = dof * std::pow(1.0 - 2.0 / (9.0 * dof) + z * std::sqrt(2.0 / (9.0 * dof)), 3.0);
      EXPECT_NEAR(chi_square_quantile(p, dof) / cube, 1.0, 1e-5) << dof;
    }
  }
}

const Eigen::Matrix3d kCovariance =
    (Eigen::Matrix3d() << 4e-4, 1e-4, 2e-5, 1e-4, 9e-4, -3e-5, 2e-5, -3e-5, 1e-5).finished();

TEST(Nees, OfAKnownError) {
  const Eigen::Matrix3d diagonal = Eigen::Vector3d(0.01, 0.04, 0.0025).asDiagonal();
  EXPECT_NEAR(*nees({1.1, 2.0, 0.0}, diagonal, {1.0, 2.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(*nees({1.1, 1.6, 0.0}, diagonal, {1.0, 2.0, 0.0}), 5.0, 1e-12);
  EXPECT_NEAR(*nees({1.0, 2.0, kPi - 0.02}, diagonal, {1.0, 2.0, -kPi + 0.03}), 1.0, 1e-9)
      << "across the seam";
}

TEST(Nees, NothingForACovarianceThatIsNone) {
  EXPECT_FALSE(nees({}, Eigen::Matrix3d::Zero(), {}));
  EXPECT_FALSE(nees({}, -kCovariance, {}));
  EXPECT_FALSE(nees({}, Eigen::Matrix3d::Constant(std::nan("")), {}));
}

std::vector<PoseEstimate> drawn(double too_large, Trajectory& truth) {
  const Eigen::Matrix3d root = Eigen::LLT<Eigen::Matrix3d>(kCovariance).matrixL();
  std::vector<PoseEstimate> estimates;
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    const Pose2 at{0.01 * i, 3.0, 3.1};
    const Eigen::Vector3d error =
        too_large * root * Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal());
    truth.add(Stamp{i}, at);
    estimates.push_back(
        {.stamp = Stamp{i},
         .map_from_base = {at.x_m + error.x(), at.y_m + error.y(), wrap_angle(at.theta_rad + error.z())},
         .covariance = kCovariance,
         .status = Status::ok});
  }
  return estimates;
}

TEST(Consistency, TellsHonestFromSureAndCareful) {
  for (const auto& [factor, verdict] :
       {std::pair{1.0, "consistent"}, {1.2, "too sure"}, {0.8, "too careful"}}) {
    Trajectory truth;
    const auto estimates = drawn(factor, truth);
    const Consistency found = consistency_of(estimates, truth);
    EXPECT_EQ(found.count, 2000U);
    EXPECT_EQ(found.verdict(), verdict) << found.mean_nees;
    // Four standard errors: NEES has variance 6.
    EXPECT_NEAR(found.mean_nees, 3.0 * factor * factor, 4.0 * factor * factor * std::sqrt(6.0 / 2000.0));
  }
}

TEST(Consistency, LeavesOutWhatIsNotOkHasNoTruthOrNoCovariance) {
  Trajectory truth;
  auto estimates = drawn(1.0, truth);
  estimates[0].status = Status::degraded;
  estimates[1].stamp = Stamp::from_seconds(1e6);
  estimates[2].covariance.setZero();
  const Consistency found = consistency_of(estimates, truth);
  EXPECT_EQ(found.count, 1997U);
  EXPECT_EQ(found.singular_count, 1U);
  EXPECT_EQ(consistency_of({}, truth).verdict(), "unknown");
}

}  // namespace
}  // namespace beaconless::eval
