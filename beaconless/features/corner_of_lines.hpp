// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include "beaconless/features/corners.hpp"

namespace beaconless {

/// Crossing of two lines as a corner, without conditions other than the sine of its angle; `arms` are the far
/// ends of both walls as seen from it. Beam and line indices are left to the caller.
inline std::optional<Corner> corner_of_lines(const ScanLine& p, const ScanLine& q, double min_sine) {
  // 1. The crossing, by Cramer's rule on the normal forms.
  const Eigen::Vector2d np = p.fit.line.normal();
  const Eigen::Vector2d nq = q.fit.line.normal();
  const double sine = np.x() * nq.y() - np.y() * nq.x();
  if (!(std::abs(sine) >= min_sine) || sine == 0.0) return std::nullopt;
  const double rp = p.fit.line.rho_m;
  const double rq = q.fit.line.rho_m;
  Corner corner;
  corner.point = {(rp * nq.y() - rq * np.y()) / sine, (rq * np.x() - rp * nq.x()) / sine};

  // 2. Its covariance: how far either line may be off there, through the inverse of (np, nq) as rows.
  const auto variance = [&corner](const LineFit& fit, const Eigen::Vector2d& normal) {
    const double t = normal.x() * corner.point.y() - normal.y() * corner.point.x();
    return t * t * fit.covariance(0, 0) - 2.0 * t * fit.covariance(0, 1) + fit.covariance(1, 1);
  };
  const double vp = variance(p.fit, np) / (sine * sine);
  const double vq = variance(q.fit, nq) / (sine * sine);
  const double xy = -(vp * nq.x() * nq.y() + vq * np.x() * np.y());
  corner.covariance << vp * nq.y() * nq.y() + vq * np.y() * np.y(), xy, xy,
      vp * nq.x() * nq.x() + vq * np.x() * np.x();

  // 3. The walls as they leave it: towards their far ends.
  const auto farther = [&corner](const ScanLine& line) {
    const Eigen::Vector2d a = line.a - corner.point;
    const Eigen::Vector2d b = line.b - corner.point;
    return a.squaredNorm() > b.squaredNorm() ? a : b;
  };
  const Eigen::Vector2d arm_p = farther(p).normalized();
  const Eigen::Vector2d arm_q = farther(q).normalized();
  const double turn = arm_p.x() * arm_q.y() - arm_p.y() * arm_q.x();
  corner.angle_rad = std::atan2(std::abs(turn), arm_p.dot(arm_q));
  const Eigen::Vector2d bisector = arm_p + arm_q;
  corner.orientation_rad = wrap_angle(std::atan2(bisector.y(), bisector.x()));
  // The sensor stands between the walls of a room's corner, and not between those of a box.
  const Eigen::Vector2d& at = corner.point;
  const double from_p = (arm_p.y() * at.x() - arm_p.x() * at.y()) * turn;
  const double from_q = (arm_q.x() * at.y() - arm_q.y() * at.x()) * turn;
  corner.is_convex = !(from_p > 0.0 && from_q > 0.0);
  corner.arm_m = std::min(p.length_m(), q.length_m());
  const Eigen::Matrix2d& spread = corner.covariance;
  const double half = 0.5 * (spread(0, 0) - spread(1, 1));
  const double worst = 0.5 * (spread(0, 0) + spread(1, 1)) + std::sqrt(half * half + xy * xy);
  corner.score = worst > 0.0 ? 1.0 / std::sqrt(worst) : 0.0;
  return corner;
}

}  // namespace beaconless
