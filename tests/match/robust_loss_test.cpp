// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/robust_loss.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace beaconless {
namespace {

template <class Loss>
class RobustLossLaws : public testing::Test {};

using Losses = testing::Types<Huber, Cauchy, Tukey, Welsch, GemanMcClure>;
TYPED_TEST_SUITE(RobustLossLaws, Losses);

constexpr double kStep = 1e-5;

double psi(const auto& loss, double u) { return u * loss.weight(u * u); }

TYPED_TEST(RobustLossLaws, ZeroCostsNothingAndCountsFully) {
  EXPECT_EQ(TypeParam{}.rho(0.0), 0.0);
  EXPECT_EQ(TypeParam{}.weight(0.0), 1.0);
  EXPECT_EQ(TypeParam{}.curvature(0.0), 1.0);
}

TYPED_TEST(RobustLossLaws, TheWeightIsTheDerivativeOfTheCostByTheResidual) {
  const TypeParam loss;
  for (double u = 0.05; u < 20.0; u += 0.0937) {
    const double up = u + kStep;
    const double down = u - kStep;
    const double slope = (loss.rho(up * up) - loss.rho(down * down)) / (2.0 * kStep);
    EXPECT_NEAR(slope, psi(loss, u), 1e-7) << "u = " << u;
  }
}

TYPED_TEST(RobustLossLaws, TheCurvatureIsTheSecondDerivativeAwayFromTheKink) {
  const TypeParam loss;
  for (double u = 0.05; u < 20.0; u += 0.0937) {
    if (std::abs(u - loss.k) < 2.0 * kStep) continue;
    EXPECT_NEAR((psi(loss, u + kStep) - psi(loss, u - kStep)) / (2.0 * kStep), loss.curvature(u * u), 1e-6)
        << u;
  }
}

TYPED_TEST(RobustLossLaws, WeightsNeverGrow) {
  const TypeParam loss;
  for (double u = 0.0; u < 50.0; u += 0.01)
    EXPECT_LE(loss.weight((u + 0.01) * (u + 0.01)), loss.weight(u * u));
}

/// Efficiency at the Gaussian: (E psi')² / E psi², by Simpson's rule over ±12 sigma, split at the kinks.
TYPED_TEST(RobustLossLaws, TheConstantIsNinetyFivePercentEfficient) {
  const TypeParam loss;
  double psi_square = 0.0;
  double slope = 0.0;
  for (const auto& [low, high] : {std::pair{-12.0, -loss.k}, {-loss.k, loss.k}, {loss.k, 12.0}}) {
    const int n = 40000;
    const double h = (high - low) / n;
    for (int i = 0; i <= n; ++i) {
      // Just inside the interval at its ends: a kink belongs to both sides.
      const double u = i == 0 ? low + 1e-12 : i == n ? high - 1e-12 : low + i * h;
      const double simpson = h / 3.0 * (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
      const double density = std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi);
      psi_square += simpson * density * psi(loss, u) * psi(loss, u);
      slope += simpson * density * loss.curvature(u * u);
    }
  }
  EXPECT_NEAR(slope * slope / psi_square, 0.95, 5e-5);
}

/// Of the length of a vector in the plane: with psi along it, V = (E psi² / 2) / (E[psi' + psi / u] / 2)²
/// under the Rayleigh distribution.
TYPED_TEST(RobustLossLaws, TheConstantInThePlaneIsNinetyFivePercentEfficient) {
  TypeParam loss;
  loss.k = TypeParam::kEfficient95InPlane;
  double psi_square = 0.0;
  double slope = 0.0;
  for (const auto& [low, high] : {std::pair{0.0, loss.k}, {loss.k, 12.0}}) {
    const int n = 40000;
    const double h = (high - low) / n;
    for (int i = 0; i <= n; ++i) {
      const double u = i == 0 ? low + 1e-12 : i == n ? high - 1e-12 : low + i * h;
      const double simpson = h / 3.0 * (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
      const double density = u * std::exp(-0.5 * u * u);
      psi_square += simpson * density * psi(loss, u) * psi(loss, u) / 2.0;
      slope += simpson * density * (loss.curvature(u * u) + loss.weight(u * u)) / 2.0;
    }
  }
  EXPECT_NEAR(slope * slope / psi_square, 0.95, 5e-5);
}

TEST(RobustLoss, TukeyAndWelschStopGrowing) {
  EXPECT_DOUBLE_EQ(Tukey{}.rho(1e6), Tukey{}.k * Tukey{}.k / 6.0);
  EXPECT_DOUBLE_EQ(Welsch{}.rho(1e6), Welsch{}.k * Welsch{}.k / 2.0);
  EXPECT_EQ(Tukey{}.weight(1e6), 0.0);
}

TEST(RobustLoss, ByNameIsTheSameLoss) {
  EXPECT_EQ(with_loss(LossKind::tukey, 0.0, [](const auto& loss) { return loss.weight(4.0); }),
            Tukey{}.weight(4.0));
  EXPECT_EQ(with_loss(LossKind::cauchy, 1.0, [](const auto& loss) { return loss.weight(1.0); }), 0.5);
  EXPECT_EQ(with_loss(
                LossKind::huber, 0.0, [](const auto& loss) { return loss.k; }, Residual::in_plane),
            Huber::kEfficient95InPlane);
  EXPECT_EQ(with_loss(
                LossKind::huber, 2.0, [](const auto& loss) { return loss.k; }, Residual::in_plane),
            2.0);
}

}  // namespace
}  // namespace beaconless
