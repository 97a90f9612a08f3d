// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/circle_fit.hpp"

#include <cmath>

#include <Eigen/Dense>

namespace beaconless {
namespace {

constexpr double kFlattest = 1000.0;  // radius in spreads of the points
constexpr int kMaxSteps = 20;

/// Kåsa's linear fit of |p|² = 2 c·p + (r² - |c|²), with p from the centroid.
std::optional<Circle2> algebraic_circle(std::span<const Eigen::Vector2d> points,
                                        const Eigen::Vector2d& centroid) {
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d third = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d p = point - centroid;
    spread += p * p.transpose();
    third += p.squaredNorm() * p;
  }
  const double trace = spread.trace();
  if (!(spread.determinant() > 1e-14 * trace * trace)) return std::nullopt;
  const Eigen::Vector2d centre = 0.5 * spread.inverse() * third;
  const double mean_square = trace / static_cast<double>(points.size());
  return Circle2{centroid + centre, std::sqrt(centre.squaredNorm() + mean_square)};
}

/// Normal equations of the distances by (x, y, radius).
struct Normal {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double square = 0.0;
};

Normal linearise(std::span<const Eigen::Vector2d> points, const Circle2& circle) {
  Normal normal;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d arm = point - circle.centre;
    const double length = std::sqrt(arm.squaredNorm());
    if (!(length > 0.0)) continue;
    const Eigen::Vector3d jacobian(-arm.x() / length, -arm.y() / length, -1.0);
    const double residual = length - circle.radius_m;
    normal.hessian += jacobian * jacobian.transpose();
    normal.gradient += residual * jacobian;
    normal.square += residual * residual;
  }
  return normal;
}

}  // namespace

std::optional<CircleFit> fit_circle(std::span<const Eigen::Vector2d> points, double sigma_m) {
  if (points.size() < 3) return std::nullopt;
  const auto n = static_cast<double>(points.size());
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) centroid += point;
  centroid /= n;
  double spread = 0.0;
  for (const Eigen::Vector2d& point : points) spread += (point - centroid).squaredNorm();
  spread = std::sqrt(spread / n);

  // 1. A start in closed form.
  const auto start = algebraic_circle(points, centroid);
  if (!start || !(start->radius_m < kFlattest * spread)) return std::nullopt;

  // 2. Gauss-Newton, with half steps where a whole one makes it worse.
  Circle2 circle = *start;
  Normal normal = linearise(points, circle);
  for (int step = 0; step < kMaxSteps; ++step) {
    Eigen::Vector3d move = -normal.hessian.ldlt().solve(normal.gradient);
    if (!move.allFinite()) return std::nullopt;
    bool better = false;
    for (int half = 0; half < 6 && !better; ++half, move *= 0.5) {
      const Circle2 trial{circle.centre + move.head<2>(), circle.radius_m + move.z()};
      if (!(trial.radius_m > 0.0) || trial.radius_m > kFlattest * spread) continue;
      const Normal there = linearise(points, trial);
      if (!(there.square <= normal.square)) continue;
      better = true;
      circle = trial;
      normal = there;
    }
    if (!better || move.squaredNorm() < 1e-18 * spread * spread) break;
  }

  // 3. How sure it is.
  CircleFit fit;
  fit.circle = circle;
  fit.count = points.size();
  fit.rms_m = std::sqrt(normal.square / n);
  const double variance = sigma_m > 0.0 ? sigma_m * sigma_m : normal.square / std::max(1.0, n - 3.0);
  fit.covariance = variance * normal.hessian.inverse();
  if (!fit.covariance.allFinite()) return std::nullopt;
  return fit;
}

}  // namespace beaconless
