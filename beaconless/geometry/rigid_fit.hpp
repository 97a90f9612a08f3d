// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// The weighted rigid motion that carries points p to their partners y with the least squared error.
///
/// Feed pairs with `add`, then ask `solve`. Cost: a dozen multiply-adds a pair, nothing is stored per pair.
/// Source: dissertation 2.3.1 (weighted SVD of C); here as psi = atan2(C_xy - C_yx, C_xx + C_yy), the closed
/// form of the same SVD in the plane. Differs: the dissertation's R = -V Uᵀ for a reflection is still a
/// reflection in 2-D; this form never gives one. Its Algorithm 6 has C of rank one (line 15) and the
/// translation reversed (line 18); both corrected.
class RigidFit {
 public:
  /// `origin_p` and `origin_y` are subtracted first; points near the data keep the sums free of cancellation.
  explicit RigidFit(const Eigen::Vector2d& origin_p = Eigen::Vector2d::Zero(),
                    const Eigen::Vector2d& origin_y = Eigen::Vector2d::Zero())
      : origin_p_(origin_p), origin_y_(origin_y) {}

  void add(const Eigen::Vector2d& p, const Eigen::Vector2d& y, double weight = 1.0) {
    const Eigen::Vector2d dp = p - origin_p_;
    const Eigen::Vector2d dy = y - origin_y_;
    weight_ += weight;
    sum_p_ += weight * dp;
    sum_y_ += weight * dy;
    square_p_ += weight * dp.squaredNorm();
    square_y_ += weight * dy.squaredNorm();
    dot_ += weight * dp.dot(dy);
    cross_ += weight * (dp.x() * dy.y() - dp.y() * dy.x());
  }

  /// y_from_p; nothing when the pairs say nothing about the heading (fewer than two distinct points).
  std::optional<Pose2> solve() const {
    if (!(weight_ > 0.0)) return std::nullopt;
    const Eigen::Vector2d mean_p = sum_p_ / weight_;
    const Eigen::Vector2d mean_y = sum_y_ / weight_;
    const double dot = dot_ / weight_ - mean_p.dot(mean_y);
    const double cross = cross_ / weight_ - (mean_p.x() * mean_y.y() - mean_p.y() * mean_y.x());
    // What sums of this size leave behind by rounding alone, when all p or all y are the same point.
    const double noise = 1e-12 * std::sqrt(square_p_ * square_y_) / weight_;
    if (!(std::hypot(dot, cross) > noise)) return std::nullopt;
    const Pose2 turn{0.0, 0.0, std::atan2(cross, dot)};
    const Eigen::Vector2d t = origin_y_ + mean_y - turn * Eigen::Vector2d(origin_p_ + mean_p);
    return Pose2{t.x(), t.y(), turn.theta_rad};
  }

 private:
  Eigen::Vector2d origin_p_;
  Eigen::Vector2d origin_y_;
  double weight_ = 0.0;
  Eigen::Vector2d sum_p_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d sum_y_ = Eigen::Vector2d::Zero();
  double square_p_ = 0.0;
  double square_y_ = 0.0;
  double dot_ = 0.0;
  double cross_ = 0.0;
};

}  // namespace beaconless
