// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/errors.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless::eval {
namespace {

/// The value that `share` of the sorted values lie below, between two of them where need be.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Statistics statistics_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  Statistics s;
  s.count = values.size();
  s.min = values.front();
  s.max = values.back();
  s.median = quantile(values, 0.5);
  s.p95 = quantile(values, 0.95);
  for (const double value : values) s.mean += value / count;
  double variance = 0.0;
  for (const double value : values) variance += (value - s.mean) * (value - s.mean) / count;
  s.sd = std::sqrt(variance);
  s.rmse = std::hypot(s.mean, s.sd);
  return s;
}

double PoseError::position_m() const { return std::hypot(x_m, y_m); }

std::vector<PoseError> errors_of(std::span<const PosePair> pairs) {
  std::vector<PoseError> errors;
  errors.reserve(pairs.size());
  for (const auto& [stamp, estimate, reference] : pairs) {
    const Eigen::Vector2d error = estimate.translation() - reference.translation();
    const Eigen::Vector2d seen = reference.rotation().transpose() * error;
    errors.push_back({stamp, estimate, reference, error.x(), error.y(), seen.x(), seen.y(),
                      wrap_angle(estimate.theta_rad - reference.theta_rad)});
  }
  return errors;
}

ErrorTable table_of(std::span<const PoseError> errors) {
  std::vector<double> position_m;
  std::vector<double> heading_deg;
  for (const PoseError& error : errors) {
    position_m.push_back(error.position_m());
    heading_deg.push_back(degrees(std::abs(error.heading_rad)));
  }
  return {statistics_of(std::move(position_m)), statistics_of(std::move(heading_deg))};
}

}  // namespace beaconless::eval
