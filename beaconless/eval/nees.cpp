// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/nees.hpp"

#include <cmath>

#include <Eigen/Cholesky>

#include "beaconless/eval/chi_square.hpp"

namespace beaconless::eval {

std::optional<double> nees(const Pose2& estimate, const Eigen::Matrix3d& covariance, const Pose2& truth) {
  const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
  if (!covariance.allFinite() || factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d error(estimate.x_m - truth.x_m, estimate.y_m - truth.y_m,
                              wrap_angle(estimate.theta_rad - truth.theta_rad));
  const double square = factor.matrixL().solve(error).squaredNorm();
  return std::isfinite(square) ? std::optional(square) : std::nullopt;
}

std::string_view Consistency::verdict() const {
  if (count == 0) return "unknown";
  if (mean_nees > high) return "too sure";
  return mean_nees < low ? "too careful" : "consistent";
}

Consistency consistency_of(std::span<const PoseEstimate> estimates, const Trajectory& truth,
                           double max_gap_s) {
  Consistency result;
  double sum = 0.0;
  for (const PoseEstimate& estimate : estimates) {
    const auto at = truth.at(estimate.stamp, max_gap_s);
    if (!estimate.ok() || !at) continue;
    if (const auto square = nees(estimate.map_from_base, estimate.covariance, *at)) {
      sum += *square;
      ++result.count;
    } else {
      ++result.singular_count;
    }
  }
  if (result.count == 0) return result;
  const auto count = static_cast<double>(result.count);
  result.mean_nees = sum / count;
  result.low = chi_square_quantile(0.025, 3.0 * count) / count;
  result.high = chi_square_quantile(0.975, 3.0 * count) / count;
  return result;
}

}  // namespace beaconless::eval
