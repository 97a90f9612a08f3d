// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/straight_pieces.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

StraightPieces::Held held_by(const std::vector<Eigen::Vector2d>& arms, double piece_m = 0.4) {
  StraightPieces pieces(piece_m);
  for (const Eigen::Vector2d& arm : arms) pieces.add(arm);
  return pieces.finish();
}

TEST(StraightPieces, AWallHoldsWhatItsNormalSays) {
  for (const double angle_rad : {0.0, 0.3, 0.5 * kPi, 2.0, -1.1}) {
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Vector2d across(-along.y(), along.x());
    std::vector<Eigen::Vector2d> arms;
    Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 41; ++i) {  // four pieces of nine points, and five that are as straight
      arms.emplace_back(2.0 * across + (0.05 * i - 1.3) * along);
      const Eigen::Vector3d jacobian(across.x(), across.y(),
                                     across.y() * arms.back().x() - across.x() * arms.back().y());
      expected += jacobian * jacobian.transpose();
    }
    const auto held = held_by(arms, 0.39);
    EXPECT_EQ(held.count, 41);
    EXPECT_LT((held.information - expected).norm(), 1e-6 * expected.norm());
    EXPECT_LT((held.information.topLeftCorner<2, 2>() * along).norm(), 1e-6);
  }
}

TEST(StraightPieces, APillarHoldsBothDirectionsAndAThicketHardlyAny) {
  std::vector<Eigen::Vector2d> arms;
  for (int i = 0; i < 63; ++i) arms.emplace_back(3.0 + 0.5 * std::cos(0.1 * i), 0.5 * std::sin(0.1 * i));
  const auto pillar = held_by(arms);
  EXPECT_NEAR(pillar.information(0, 0), 0.5 * pillar.count, 0.1 * pillar.count);
  EXPECT_NEAR(pillar.information(1, 1), 0.5 * pillar.count, 0.1 * pillar.count);
  arms.clear();
  Rng rng(2);
  for (int i = 0; i < 400; ++i) arms.emplace_back(rng.uniform(2.0, 3.0), rng.uniform(0.0, 1.0));
  EXPECT_LT(held_by(arms).count, 200);
}

TEST(StraightPieces, FewPointsOrAllInOnePlaceHoldNothing) {
  EXPECT_EQ(held_by({}).count, 0);
  EXPECT_EQ(held_by({{1, 1}, {2, 1}, {3, 1}}).count, 0);
  const auto same = held_by(std::vector<Eigen::Vector2d>(30, {1.0, 2.0}));
  EXPECT_EQ(same.count, 0);
  EXPECT_TRUE(same.information.allFinite());
}

TEST(StraightPieces, NoiseTurnsThemLittle) {
  Rng rng(1);
  std::vector<Eigen::Vector2d> arms;
  for (int i = 0; i < 400; ++i) arms.emplace_back(0.01 * i, 1.0 + rng.normal(0.01));
  const auto held = held_by(arms);
  EXPECT_EQ(held.count, 400);
  // 41 points of 10 mm over 0.4 m: the slope's standard deviation is 0.013, its square's mean 1.8e-4.
  EXPECT_LT(held.information(0, 0) / held.count, 6e-4);
}

}  // namespace
}  // namespace beaconless
