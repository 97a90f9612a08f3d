// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/fit_pairs.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "beaconless/geometry/rigid_fit.hpp"

namespace beaconless {
namespace {

double residual_m2(const FeatureSet& first, const FeatureSet& second, const FeaturePair& pair,
                   const Pose2& pose) {
  return (pose * first.points[pair.first] - second.points[pair.second]).squaredNorm();
}

/// sigma_m is what passes the gates, wider than what detectors do at their best; no scatter is taken for less
/// than this share of it.
constexpr double kLeastOfSigma = 0.1;

double cauchy(double square_m2, double scale_m) { return 1.0 / (1.0 + square_m2 / (scale_m * scale_m)); }

/// The covariance of a pose whose pairs scatter by sigma_m each axis, and the direction it knows least.
void tell_certainty(const FeatureSet& first, const FeatureSet& second, std::span<const FeaturePair> pairs,
                    double scale_m, const PairingConfig& config, MatchResult& result) {
  const Pose2 pose = result.map_from_laser;
  const Eigen::Matrix2d rotation = pose.rotation();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  double weights = 0.0;
  for (const FeaturePair& pair : pairs) {
    const double square = residual_m2(first, second, pair, pose);
    const double weight = cauchy(square, scale_m);
    const Eigen::Vector2d arm = rotation * first.points[pair.first];
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
    information += weight * jacobian.transpose() * jacobian;
    squares += weight * square;
    weights += weight;
  }
  // Three unknowns are fitted, and a scatter seen from few pairs is itself uncertain: dividing by two less
  // than the degrees of freedom gives the variance of Student's t. Residuals small by luck are not believed.
  const double freedom = std::max(2.0 * weights - 5.0, 1.0);
  const double sigma_m = std::max(std::sqrt(squares / freedom), kLeastOfSigma * config.sigma_m);
  result.covariance = sigma_m * sigma_m * information.inverse();
  result.scale_m = scale_m;
}

}  // namespace

MatchResult fit_pairs(const FeatureSet& first, const FeatureSet& second, std::span<const FeaturePair> pairs,
                      const Pose2& guess, const PairingConfig& config) {
  constexpr int kReweightings = 5;
  MatchResult result;
  result.map_from_laser = guess;
  result.status = MatchStatus::too_few_pairs;
  result.pair_count = static_cast<int>(pairs.size());
  if (pairs.empty() || result.pair_count < config.min_pairs) return result;

  double scale_m = std::sqrt(config.same_place_m2());
  for (int round = 0; round <= kReweightings; ++round) {
    // 1. The closed form, with everybody's weight from the pose before.
    RigidFit fit(first.points[pairs.front().first], second.points[pairs.front().second]);
    for (const FeaturePair& pair : pairs) {
      const double weight =
          round == 0 ? 1.0 : cauchy(residual_m2(first, second, pair, result.map_from_laser), scale_m);
      fit.add(first.points[pair.first], second.points[pair.second], weight);
    }
    const auto pose = fit.solve();
    if (!pose) return result;
    result.map_from_laser = {pose->x_m, pose->y_m, wrap_angle(pose->theta_rad)};

    // 2. What residuals are usual.
    double sum = 0.0;
    for (const FeaturePair& pair : pairs)
      sum += std::sqrt(residual_m2(first, second, pair, result.map_from_laser));
    scale_m = std::max(sum / static_cast<double>(pairs.size()), kLeastOfSigma * config.sigma_m);
  }

  // 3. A pose, and what it is worth.
  result.status = MatchStatus::converged;
  result.rank = 3;
  tell_certainty(first, second, pairs, scale_m, config, result);
  return result;
}

}  // namespace beaconless
