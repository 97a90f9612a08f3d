// SPDX-License-Identifier: Apache-2.0
// The loop over the beams, against the same written plainly.
#include "beaconless/match/wall_beams.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

struct Beam {
  Eigen::Vector2d end;
  Eigen::Vector2d unit;
  Eigen::Vector2d normal;
  double offset_m;
  double information;
};

/// Beams of a noisy scan of walls on every side, some of them on people.
std::vector<Beam> beams_of(int count, Rng& rng) {
  std::vector<Beam> beams;
  for (int i = 0; i < count; ++i) {
    const double bearing = rng.uniform(-kPi, kPi);
    const double slant = rng.uniform(-1.3, 1.3);
    const double range = rng.uniform(0.5, 20.0);
    const Eigen::Vector2d unit(std::cos(bearing), std::sin(bearing));
    const Eigen::Vector2d normal(std::cos(bearing + slant), std::sin(bearing + slant));
    const double noise = i % 9 == 0 ? -0.4 : rng.normal(0.01);
    beams.push_back({(range + noise) * unit, unit, normal, range * normal.dot(unit), rng.uniform(2e3, 2e4)});
  }
  return beams;
}

WallBeams loaded(const std::vector<Beam>& beams) {
  WallBeams all;
  all.reserve(beams.size());
  for (const Beam& beam : beams) all.add(beam.end, beam.unit, beam.normal, beam.offset_m, beam.information);
  all.fill_up();
  return all;
}

/// How far beyond its wall a beam ends, along the beam, with the laser moved by `step`.
double beyond_m(const Beam& beam, const Pose2& step) {
  const Eigen::Vector2d end = step * beam.end;
  return (beam.normal.dot(end) - beam.offset_m) / beam.normal.dot(step.rotation() * beam.unit);
}

WallSums plain_sums(const std::vector<Beam>& beams, const Pose2& step, double cut) {
  constexpr double kSmall = 1e-6;
  WallSums sums;
  for (const Beam& beam : beams) {
    const double e = beyond_m(beam, step);
    Eigen::Vector3d slope;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d by = kSmall * Eigen::Vector3d::Unit(k);
      slope[k] = (beyond_m(beam, stepped(step, by)) - beyond_m(beam, stepped(step, -by))) / (2.0 * kSmall);
    }
    const double z2 = e * e * beam.information;
    const double left = std::max(0.0, 1.0 - z2 / (cut * cut));
    const double weight = left * left;
    sums.hessian += weight * beam.information * slope * slope.transpose();
    sums.gradient += weight * beam.information * e * slope;
    sums.weight += weight;
    sums.weighted_squares += weight * z2;
    sums.squared_influence += weight * weight * z2;
    sums.curvature += left * (1.0 - 5.0 * z2 / (cut * cut));
    sums.arm_squares_m2 += weight * beam.end.squaredNorm();
  }
  return sums;
}

void expect_same(const WallSums& sums, const WallSums& other, double share) {
  EXPECT_LE((sums.hessian - other.hessian).norm(), share * other.hessian.norm());
  EXPECT_LE((sums.gradient - other.gradient).norm(), share * other.hessian.norm());
  EXPECT_NEAR(sums.weight, other.weight, share * other.weight);
  EXPECT_NEAR(sums.weighted_squares, other.weighted_squares, share * other.weighted_squares);
  EXPECT_NEAR(sums.squared_influence, other.squared_influence, share * other.squared_influence);
  EXPECT_NEAR(sums.curvature, other.curvature, share * other.weight);
  EXPECT_NEAR(sums.arm_squares_m2, other.arm_squares_m2, share * other.arm_squares_m2);
}

TEST(WallBeams, SumsAreThoseOfThePlainLoop) {
  Rng rng(3);
  for (const int count : {1, 2, 3, 5, 64, 1081}) {
    const auto beams = beams_of(count, rng);
    const Pose2 step{0.004, -0.003, 0.002};
    expect_same(sum_walls(loaded(beams), step, 6.0, VectorLoop::portable), plain_sums(beams, step, 6.0),
                1e-6);
  }
}

/// Tukey's loss, whose slope is z times the weight.
double loss_of(const std::vector<Beam>& beams, const Pose2& step, double cut) {
  double sum = 0.0;
  for (const Beam& beam : beams) {
    const double e = beyond_m(beam, step);
    const double left = std::max(0.0, 1.0 - e * e * beam.information / (cut * cut));
    sum += cut * cut / 6.0 * (1.0 - left * left * left);
  }
  return sum;
}

TEST(WallBeams, GradientIsTheSlopeOfTheLoss) {
  constexpr double kSmall = 1e-7;  // a beam of 20 m at a slant moves by standard deviations in a milliradian
  constexpr double kCut = 6.0;
  Rng rng(8);
  for (int run = 0; run < 20; ++run) {
    const auto beams = beams_of(60, rng);
    const Pose2 step{rng.uniform(-0.01, 0.01), rng.uniform(-0.01, 0.01), rng.uniform(-0.002, 0.002)};
    const Eigen::Vector3d gradient = sum_walls(loaded(beams), step, kCut, fastest_vector_loop()).gradient;
    Eigen::Vector3d slope;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d by = kSmall * Eigen::Vector3d::Unit(k);
      slope[k] = (loss_of(beams, stepped(step, by), kCut) - loss_of(beams, stepped(step, -by), kCut)) /
                 (2.0 * kSmall);
    }
    EXPECT_LT((gradient - slope).norm(), 1e-6 * gradient.norm());
  }
}

/// Of one beam H is J J^T, but for its weight.
TEST(WallBeams, SlopesOfABeamAreThoseOfItsRange) {
  constexpr double kSmall = 1e-5;
  Rng rng(9);
  for (int run = 0; run < 200; ++run) {
    const auto beams = beams_of(2, rng);
    const std::vector<Beam> one{beams.back()};
    const Pose2 step{rng.uniform(-0.01, 0.01), rng.uniform(-0.01, 0.01), rng.uniform(-0.002, 0.002)};
    const WallSums sums = sum_walls(loaded(one), step, 1e6, fastest_vector_loop());
    Eigen::Vector3d slope;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d by = kSmall * Eigen::Vector3d::Unit(k);
      slope[k] =
          (beyond_m(one[0], stepped(step, by)) - beyond_m(one[0], stepped(step, -by))) / (2.0 * kSmall);
    }
    const Eigen::Matrix3d squares = sums.hessian / one[0].information;
    EXPECT_LT((squares - slope * slope.transpose()).norm(), 1e-6 * squares.norm());
  }
}

TEST(WallBeams, EveryLoopGivesTheSame) {
  if (fastest_vector_loop() == VectorLoop::portable)
    GTEST_SKIP() << "this processor knows the portable loop only";
  Rng rng(4);
  const auto beams = loaded(beams_of(1081, rng));
  for (const double turn : {0.0, 0.01, 3.0}) {
    const Pose2 step{0.01, 0.02, turn};
    expect_same(sum_walls(beams, step, 5.0, VectorLoop::avx2),
                sum_walls(beams, step, 5.0, VectorLoop::portable), 1e-12);
  }
}

TEST(WallBeams, KeepTheirRoomFromScanToScan) {
  Rng rng(5);
  const auto many = beams_of(400, rng);
  const auto few = beams_of(7, rng);
  WallBeams beams = loaded(many);
  beams.clear();
  for (const Beam& beam : few) beams.add(beam.end, beam.unit, beam.normal, beam.offset_m, beam.information);
  beams.fill_up();
  expect_same(sum_walls(beams, {}, 6.0, fastest_vector_loop()),
              sum_walls(loaded(few), {}, 6.0, fastest_vector_loop()), 1e-15);
}

}  // namespace
}  // namespace beaconless
