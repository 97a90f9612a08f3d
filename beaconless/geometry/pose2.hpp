// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>

#include <Eigen/Core>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {

/// A motion in the plane per unit of time: the tangent of Pose2 at the identity, in the moving frame.
struct Twist2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;

  friend Twist2 operator*(double factor, const Twist2& twist) {
    return {factor * twist.x_m, factor * twist.y_m, factor * twist.theta_rad};
  }
  Eigen::Vector3d vector() const { return {x_m, y_m, theta_rad}; }
  friend bool operator==(const Twist2&, const Twist2&) = default;
};

/// A pose in the plane, and the rigid motion SE(2) that carries coordinates from one frame to another.
///
/// Variables name both frames, `a_from_b`, so that products cancel when read aloud:
/// `map_from_laser = map_from_base * base_from_laser`. Heading is counter-clockwise from x; results of
/// operations have it in [-pi, pi).
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;

  /// Source: the closed form of the SE(2) exponential, with its Taylor series below 1e-4 rad.
  static Pose2 exp(const Twist2& twist);

  /// The twist whose exponential is this pose; heading in [-pi, pi).
  Twist2 log() const;

  Pose2 inverse() const;

  Eigen::Vector2d translation() const { return {x_m, y_m}; }
  Eigen::Matrix2d rotation() const;

  /// Adjoint: `T * exp(v) == exp(T.adjoint() * v) * T`.
  Eigen::Matrix3d adjoint() const;

  bool is_finite() const { return std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(theta_rad); }

  friend Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c);
  friend Eigen::Vector2d operator*(const Pose2& a_from_b, const Eigen::Vector2d& point_b);
  friend bool operator==(const Pose2&, const Pose2&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Pose2& pose) {
    return out << "(" << pose.x_m << " m, " << pose.y_m << " m, " << degrees(pose.theta_rad) << " deg)";
  }
};

/// The pose after a step (m, m, rad) along the map's axes, as least-squares solvers make them.
inline Pose2 stepped(const Pose2& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.theta_rad + step.z())};
}

/// Metres between the two origins.
double distance_m(const Pose2& a, const Pose2& b);

/// Absolute difference of the two headings, in [0, pi].
double heading_difference_rad(const Pose2& a, const Pose2& b);

/// The pose `fraction` of the way from `a` (0) to `b` (1) along a constant twist; beyond both ends too.
Pose2 interpolate(const Pose2& a, const Pose2& b, double fraction);

/// The covariance of (x, y, theta) of `map_from_b` when that of `map_from_a` is given and b is rigidly fixed
/// to a.
///
/// In: 3x3, ordered x, y, theta, in m², m·rad, rad², x and y along the map axes.
Eigen::Matrix3d moved_covariance(const Eigen::Matrix3d& covariance_a, const Pose2& map_from_a,
                                 const Pose2& a_from_b);

}  // namespace beaconless
