// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

namespace beaconless {

/// A circle, in metres.
struct Circle2 {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius_m = 0.0;

  double signed_distance_m(const Eigen::Vector2d& point) const { return (point - centre).norm() - radius_m; }

  friend bool operator==(const Circle2&, const Circle2&) = default;
};

/// A circle through points, and how sure it is.
struct CircleFit {
  Circle2 circle;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, radius), m²
  double rms_m = 0.0;                                    ///< of the distances from the circle
  std::size_t count = 0;
};

/// The circle with the least sum of squared distances from the points.
///
/// In: the noise across the circle (m), or 0: what the residuals tell. Nothing for fewer than three points,
/// for points on a line and for circles so flat that their radius exceeds 1000 times the points' spread.
/// Cost: three to ten passes over the points, no allocation.
///
/// Source: dissertation eq. (2), a x² + b xy + c y² + 2dx + 2ey + f = 0 with a = c, b = 0: centre (-d/a,
/// -e/a), radius² = (d² + e² - a f)/a². Started algebraically (Kåsa 1976, linear), then Gauss-Newton on the
/// distances, since the linear fit shrinks short arcs. Differs: the dissertation demands a and c different
/// from zero, which excludes its own line (a = b = c = 0; there (d, e) must not vanish instead), and calls
/// b² - ac < 0 an ellipse, which holds for a term 2bxy: for bxy it is b² - 4ac < 0.
std::optional<CircleFit> fit_circle(std::span<const Eigen::Vector2d> points, double sigma_m = 0.0);

}  // namespace beaconless
