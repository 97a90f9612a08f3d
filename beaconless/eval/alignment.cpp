// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/alignment.hpp"

#include <cmath>

#include "beaconless/geometry/rigid_fit.hpp"

namespace beaconless::eval {
namespace {

/// The middle of the positions, summed near the first so that far coordinates lose nothing.
Eigen::Vector2d middle(std::span<const PosePair> pairs, Pose2 PosePair::*side) {
  const Eigen::Vector2d first = (pairs.front().*side).translation();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const PosePair& pair : pairs) sum += (pair.*side).translation() - first;
  return first + sum / static_cast<double>(pairs.size());
}

double mean_heading_difference_rad(std::span<const PosePair> pairs) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const PosePair& pair : pairs) {
    const double difference = pair.reference.theta_rad - pair.estimate.theta_rad;
    sum += Eigen::Vector2d(std::cos(difference), std::sin(difference));
  }
  return std::atan2(sum.y(), sum.x());
}

}  // namespace

Pose2 align(std::span<const PosePair> pairs) {
  if (pairs.empty()) return {};
  const Eigen::Vector2d middle_e = middle(pairs, &PosePair::estimate);
  const Eigen::Vector2d middle_r = middle(pairs, &PosePair::reference);
  RigidFit fit(middle_e, middle_r);
  double square_m2 = 0.0;
  for (const auto& [stamp, estimate, reference] : pairs) {
    fit.add(estimate.translation(), reference.translation());
    square_m2 += (reference.translation() - middle_r).squaredNorm();
  }
  if (std::sqrt(square_m2 / static_cast<double>(pairs.size())) >= kLeastSpread_m)
    if (const auto aligned = fit.solve()) return *aligned;

  const Pose2 turn{0.0, 0.0, mean_heading_difference_rad(pairs)};
  const Eigen::Vector2d t = middle_r - turn * middle_e;
  return {t.x(), t.y(), turn.theta_rad};
}

}  // namespace beaconless::eval
