// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {

/// An infinite line in normal form: x cos(alpha) + y sin(alpha) = rho, with rho >= 0.
///
/// Source: the Hesse normal form; the dissertation uses y = m x + b.
/// Differs: that form has no vertical lines (dissertation, Algorithm 3 and 5).
struct Line2 {
  double alpha_rad = 0.0;
  double rho_m = 0.0;

  /// The line through two points; nothing when they are the same point.
  static std::optional<Line2> through(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    const Eigen::Vector2d along = q - p;
    if (along.squaredNorm() <= 0.0) return std::nullopt;
    const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    const double rho = normal.dot(p);
    return rho < 0.0 ? Line2{std::atan2(-normal.y(), -normal.x()), -rho}
                     : Line2{std::atan2(normal.y(), normal.x()), rho};
  }

  Eigen::Vector2d normal() const { return {std::cos(alpha_rad), std::sin(alpha_rad)}; }

  /// Metres from the line, positive on the side away from the origin.
  double signed_distance_m(const Eigen::Vector2d& point) const { return normal().dot(point) - rho_m; }

  friend bool operator==(const Line2&, const Line2&) = default;
};

/// Where two lines cross; nothing when they are closer to parallel than `min_angle_rad`.
///
/// Source: Cramer's rule on the two normal forms; dissertation Algorithm 5.
inline std::optional<Eigen::Vector2d> intersection(const Line2& p, const Line2& q,
                                                   double min_angle_rad = 1e-9) {
  const double sine = std::sin(q.alpha_rad - p.alpha_rad);
  if (!(std::abs(sine) >= std::sin(min_angle_rad))) return std::nullopt;
  return Eigen::Vector2d{(p.rho_m * std::sin(q.alpha_rad) - q.rho_m * std::sin(p.alpha_rad)) / sine,
                         (q.rho_m * std::cos(p.alpha_rad) - p.rho_m * std::cos(q.alpha_rad)) / sine};
}

}  // namespace beaconless
