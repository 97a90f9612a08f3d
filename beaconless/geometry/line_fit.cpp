// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/line_fit.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

// Spread along a line that rounding alone could make, relative to the points' distance from the origin.
constexpr double kNoSpread = 1e-13;

/// Normal form, its normal away from the origin, and the covariance for a noise of `sigma_m` across.
LineFit line_fit_of(const PrincipalLine& line, const PointMoments& sums, double sigma_m) {
  LineFit fit;
  const double sign = line.rho_m < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector2d normal = sign * line.normal;
  fit.line = {std::atan2(normal.y(), normal.x()), sign * line.rho_m};
  fit.centroid = line.centroid;
  fit.rms_m = std::sqrt(line.across_square / sums.weight);
  fit.count = static_cast<std::size_t>(std::lround(sums.count));
  const double variance =
      sigma_m > 0.0 ? sigma_m * sigma_m : line.across_square / std::max(1.0, sums.count - 2.0);
  const double along = normal.x() * fit.centroid.y() - normal.y() * fit.centroid.x();
  const double turn = variance / line.along_square;
  fit.covariance << turn, along * turn, along * turn, variance / sums.weight + along * along * turn;
  return fit;
}

PointMoments moments_of(std::span<const Eigen::Vector2d> points) {
  PointMoments sums;
  for (const Eigen::Vector2d& point : points) sums.add(point.x(), point.y());
  return sums;
}

bool has_spread(const PrincipalLine& line, const PointMoments& sums) {
  return line.along_square > kNoSpread * (sums.xx + sums.yy);
}

}  // namespace

double LineFit::variance_at(const Eigen::Vector2d& point) const {
  const double along = -point.x() * std::sin(line.alpha_rad) + point.y() * std::cos(line.alpha_rad);
  return along * along * covariance(0, 0) - 2.0 * along * covariance(0, 1) + covariance(1, 1);
}

void describe(Fields& fields, LineFitConfig& config) {
  fields("method", config.method, {"regression", "tls", "ransac", "theil-sen"},
         "how a line is fitted to its points");
  fields("sigma_m", config.sigma_m, {0.0, 1.0},
         "standard deviation of the points across a line; 0: what the residuals tell");
  fields("ransac_tolerance_m", config.ransac_tolerance_m, {1e-4, 10.0},
         "points further from the line count as outliers");
  fields("ransac_min_base_m", config.ransac_min_base_m, {0.0, 10.0},
         "points nearer to each other than this make no line");
  fields("ransac_confidence_ratio", config.ransac_confidence_ratio, {0.5, 0.999999},
         "how sure it must be that a pair without outliers was drawn");
  fields("ransac_max_draws", config.ransac_max_draws, {1, 100000}, "most pairs that are drawn");
  fields("ransac_seed", config.ransac_seed, {0, 2147483647}, "of the pairs that are drawn");
  fields("theil_sen_max_pairs", config.theil_sen_max_pairs, {100, 100000000},
         "with more pairs of points than this, they are thinned evenly");
}

std::optional<LineFit> fit_line_tls(const PointMoments& sums, double sigma_m) {
  return fit_line_tls(sums, principal_line(sums), sigma_m);
}

std::optional<LineFit> fit_line_tls(const PointMoments& sums, const PrincipalLine& line, double sigma_m) {
  if (!(sums.count >= 2.0) || !has_spread(line, sums)) return std::nullopt;
  return line_fit_of(line, sums, sigma_m);
}

std::optional<LineFit> fit_line_tls(std::span<const Eigen::Vector2d> points, double sigma_m) {
  return fit_line_tls(moments_of(points), sigma_m);
}

std::optional<LineFit> fit_line_tls(std::span<const Eigen::Vector2d> points, std::span<const double> weights,
                                    double sigma_m) {
  PointMoments sums;
  for (std::size_t i = 0; i < std::min(points.size(), weights.size()); ++i)
    if (weights[i] > 0.0) sums.add(points[i].x(), points[i].y(), weights[i]);
  return fit_line_tls(sums, sigma_m);
}

std::optional<LineFit> fit_line_regression(std::span<const Eigen::Vector2d> points, double sigma_m) {
  const PointMoments sums = moments_of(points);
  if (!(sums.count >= 2.0)) return std::nullopt;
  PrincipalLine line = principal_line(sums);
  if (!has_spread(line, sums)) return std::nullopt;
  const double xx = sums.xx - sums.x * line.centroid.x();
  const double yy = sums.yy - sums.y * line.centroid.y();
  const double xy = sums.xy - sums.x * line.centroid.y();
  // y = m x + q has the normal (-m, 1), x = m y + q the normal (1, -m).
  line.normal = yy > xx ? Eigen::Vector2d(1.0, -xy / yy) : Eigen::Vector2d(-xy / xx, 1.0);
  line.normal.normalize();
  line.rho_m = line.normal.dot(line.centroid);
  const Eigen::Vector2d n = line.normal;
  line.across_square = std::max(0.0, n.x() * n.x() * xx + 2.0 * n.x() * n.y() * xy + n.y() * n.y() * yy);
  line.along_square = xx + yy - line.across_square;
  return line_fit_of(line, sums, sigma_m);
}

std::optional<LineFit> fit_line(std::span<const Eigen::Vector2d> points, const LineFitConfig& config,
                                LineFitScratch& scratch) {
  switch (config.method) {
    case LineFitMethod::regression:
      return fit_line_regression(points, config.sigma_m);
    case LineFitMethod::ransac:
      return fit_line_ransac(points, config);
    case LineFitMethod::theil_sen:
      return fit_line_theil_sen(points, config, scratch);
    case LineFitMethod::tls:
      break;
  }
  return fit_line_tls(points, config.sigma_m);
}

std::optional<LineFit> fit_line(std::span<const Eigen::Vector2d> points, const LineFitConfig& config) {
  LineFitScratch scratch;
  return fit_line(points, config, scratch);
}

}  // namespace beaconless
