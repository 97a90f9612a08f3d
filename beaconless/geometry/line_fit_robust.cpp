// SPDX-License-Identifier: Apache-2.0
// The line fits that bear outliers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/line_fit.hpp"

namespace beaconless {
namespace {

// How much worse than the mean and the least-squares slope medians are with Gaussian noise (Sen 1968).
constexpr double kMedianVariance = kPi / 2.0;
constexpr double kSlopeVariance = kPi / 3.0;
constexpr double kGaussianMad = 1.4826;  // standard deviation of a Gaussian from its median absolute value

/// The element in the middle; of an even number the mean of the two there.
double median(std::vector<double>& values) {
  const auto half = static_cast<std::ptrdiff_t>(values.size() / 2);
  const auto middle = values.begin() + half;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double norm(const Eigen::Vector2d& v) { return std::sqrt(v.squaredNorm()); }

/// A line through two points as (normal, rho) with its MSAC cost.
struct Candidate {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  double rho_m = 0.0;
  double cost = std::numeric_limits<double>::infinity();
  std::size_t inliers = 0;
};

Candidate judge(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                double tolerance_m) {
  Candidate candidate;
  const Eigen::Vector2d along = (q - p) / norm(q - p);
  candidate.normal = {along.y(), -along.x()};
  candidate.rho_m = candidate.normal.dot(p);
  candidate.cost = 0.0;
  const double most = tolerance_m * tolerance_m;
  for (const Eigen::Vector2d& point : points) {
    const double distance = candidate.normal.dot(point) - candidate.rho_m;
    const double square = distance * distance;
    candidate.cost += std::min(square, most);
    candidate.inliers += square <= most ? 1 : 0;
  }
  return candidate;
}

/// How many draws make it as sure as asked that one met no outlier. Source: ln(1 - p) / ln(1 - w²).
double draws_needed(double inlier_ratio, double confidence) {
  const double good = inlier_ratio * inlier_ratio;
  if (good >= 1.0) return 1.0;
  return std::ceil(std::log1p(-confidence) / std::log1p(-good));
}

PointMoments inlier_moments(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& normal,
                            double rho_m, double tolerance_m) {
  PointMoments sums;
  for (const Eigen::Vector2d& point : points)
    if (std::abs(normal.dot(point) - rho_m) <= tolerance_m) sums.add(point.x(), point.y());
  return sums;
}

/// Calls `visit(p, q)` for the pairs i < j whose gap is a multiple of the least step that keeps within the
/// cap.
template <class Visit>
void for_each_pair(std::span<const Eigen::Vector2d> points, int max_pairs, Visit&& visit) {
  const std::size_t n = points.size();
  const std::size_t all = n * (n - 1) / 2;
  const std::size_t step =
      (all + static_cast<std::size_t>(max_pairs) - 1) / static_cast<std::size_t>(max_pairs);
  for (std::size_t gap = step; gap < n; gap += step)
    for (std::size_t i = 0; i + gap < n; ++i) visit(points[i], points[i + gap]);
}

}  // namespace

std::optional<LineFit> fit_line_ransac(std::span<const Eigen::Vector2d> points, const LineFitConfig& config) {
  const std::size_t n = points.size();
  if (n < 2) return std::nullopt;
  // 1. Draw pairs until it is sure enough that one was good.
  Rng rng(static_cast<std::uint64_t>(config.ransac_seed));
  Candidate best;
  double needed = config.ransac_max_draws;
  for (int draw = 0; draw < config.ransac_max_draws && draw < needed; ++draw) {
    const auto first = static_cast<std::size_t>(rng.uniform() * static_cast<double>(n));
    const auto other = static_cast<std::size_t>(rng.uniform() * static_cast<double>(n - 1));
    const Eigen::Vector2d& p = points[first];
    const Eigen::Vector2d& q = points[other < first ? other : other + 1];
    const double base = norm(q - p);
    if (!(base > 0.0) || base < config.ransac_min_base_m) continue;
    const Candidate candidate = judge(points, p, q, config.ransac_tolerance_m);
    if (!(candidate.cost < best.cost)) continue;
    best = candidate;
    const double ratio = static_cast<double>(best.inliers) / static_cast<double>(n);
    needed = draws_needed(ratio, config.ransac_confidence_ratio);
  }
  if (best.inliers < 2) return fit_line_tls(points, config.sigma_m);

  // 2. Refit to what agrees, twice, since the line moves a little and with it who agrees.
  PointMoments sums = inlier_moments(points, best.normal, best.rho_m, config.ransac_tolerance_m);
  const PrincipalLine line = principal_line(sums);
  const PointMoments again = inlier_moments(points, line.normal, line.rho_m, config.ransac_tolerance_m);
  if (again.count >= sums.count) sums = again;
  return fit_line_tls(sums, config.sigma_m);
}

std::optional<LineFit> fit_line_theil_sen(std::span<const Eigen::Vector2d> points,
                                          const LineFitConfig& config, LineFitScratch& scratch) {
  auto start = fit_line_tls(points);
  if (!start) return std::nullopt;
  std::vector<double>& values = scratch.values;

  // 1. Median slope in the axes of the direction so far; twice, as outliers turn the first direction.
  Eigen::Vector2d along(-std::sin(start->line.alpha_rad), std::cos(start->line.alpha_rad));
  for (int turn = 0; turn < 3; ++turn) {
    const Eigen::Vector2d across(-along.y(), along.x());
    values.clear();
    for_each_pair(points, config.theil_sen_max_pairs, [&](const auto& p, const auto& q) {
      const double run = along.dot(q - p);
      if (run != 0.0) values.push_back(across.dot(q - p) / run);
    });
    if (values.empty()) return start;
    along = along + median(values) * across;
    along /= norm(along);
  }

  // 2. Median offset.
  Eigen::Vector2d normal(along.y(), -along.x());
  values.clear();
  for (const Eigen::Vector2d& point : points) values.push_back(normal.dot(point));
  double rho = median(values);
  if (rho < 0.0) {
    rho = -rho;
    normal = -normal;
  }

  // 3. Noise from the median residual, and the covariance that medians have.
  LineFit fit = *start;
  fit.line = {std::atan2(normal.y(), normal.x()), rho};
  PointMoments sums;
  double across_square = 0.0;
  values.clear();
  for (const Eigen::Vector2d& point : points) {
    const double distance = normal.dot(point) - rho;
    const double t = normal.x() * point.y() - normal.y() * point.x();
    sums.add(t, distance);
    across_square += distance * distance;
    values.push_back(std::abs(distance));
  }
  const double n = sums.count;
  const double mean = sums.x / n;
  const double sigma = config.sigma_m > 0.0 ? config.sigma_m : kGaussianMad * median(values);
  const double turn = kSlopeVariance * sigma * sigma / std::max(sums.xx - sums.x * mean, 1e-300);
  fit.rms_m = std::sqrt(across_square / n);
  fit.covariance << turn, mean * turn, mean * turn, kMedianVariance * sigma * sigma / n + mean * mean * turn;
  return fit;
}

}  // namespace beaconless
