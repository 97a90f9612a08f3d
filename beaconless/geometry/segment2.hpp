// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace beaconless {

/// A straight piece of wall between two points, in metres.
struct Segment2 {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();

  double length_m() const { return (b - a).norm(); }

  /// The point of the segment that lies nearest to `point`; `a` for a segment of no length.
  Eigen::Vector2d nearest(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d along = b - a;
    const double square = along.squaredNorm();
    if (square <= 0.0) return a;
    return a + std::clamp(along.dot(point - a) / square, 0.0, 1.0) * along;
  }

  double distance_m(const Eigen::Vector2d& point) const { return (point - nearest(point)).norm(); }

  friend bool operator==(const Segment2& p, const Segment2& q) { return p.a == q.a && p.b == q.b; }
};

}  // namespace beaconless
