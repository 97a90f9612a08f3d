// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {
namespace {

constexpr double kSeriesBelow_rad = 1e-4;

/// The two numbers of V(theta) = [[a, -b], [b, a]], which carries the twist's translation to the pose's.
struct LeftJacobian {
  double a;
  double b;

  explicit LeftJacobian(double theta_rad) {
    if (std::abs(theta_rad) < kSeriesBelow_rad) {
      const double square = theta_rad * theta_rad;
      a = 1.0 - square / 6.0;
      b = theta_rad * (0.5 - square / 24.0);
    } else {
      const double half = std::sin(0.5 * theta_rad);  // 1 - cos(theta) loses the small angles
      a = std::sin(theta_rad) / theta_rad;
      b = 2.0 * half * half / theta_rad;
    }
  }
};

}  // namespace

Pose2 Pose2::exp(const Twist2& twist) {
  const LeftJacobian v(twist.theta_rad);
  return {v.a * twist.x_m - v.b * twist.y_m, v.b * twist.x_m + v.a * twist.y_m, wrap_angle(twist.theta_rad)};
}

Twist2 Pose2::log() const {
  const double theta = wrap_angle(theta_rad);
  const LeftJacobian v(theta);
  const double determinant = v.a * v.a + v.b * v.b;
  return {(v.a * x_m + v.b * y_m) / determinant, (v.a * y_m - v.b * x_m) / determinant, theta};
}

Pose2 Pose2::inverse() const {
  const double c = std::cos(theta_rad);
  const double s = std::sin(theta_rad);
  return {-(c * x_m + s * y_m), -(c * y_m - s * x_m), wrap_angle(-theta_rad)};
}

Eigen::Matrix2d Pose2::rotation() const {
  const double c = std::cos(theta_rad);
  const double s = std::sin(theta_rad);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

Eigen::Matrix3d Pose2::adjoint() const {
  Eigen::Matrix3d adjoint = Eigen::Matrix3d::Identity();
  adjoint.topLeftCorner<2, 2>() = rotation();
  adjoint(0, 2) = y_m;
  adjoint(1, 2) = -x_m;
  return adjoint;
}

Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
  const Eigen::Vector2d moved = a_from_b * b_from_c.translation();
  return {moved.x(), moved.y(), wrap_angle(a_from_b.theta_rad + b_from_c.theta_rad)};
}

Eigen::Vector2d operator*(const Pose2& a_from_b, const Eigen::Vector2d& point_b) {
  const double c = std::cos(a_from_b.theta_rad);
  const double s = std::sin(a_from_b.theta_rad);
  return {a_from_b.x_m + c * point_b.x() - s * point_b.y(), a_from_b.y_m + s * point_b.x() + c * point_b.y()};
}

double distance_m(const Pose2& a, const Pose2& b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

double heading_difference_rad(const Pose2& a, const Pose2& b) {
  return std::abs(wrap_angle(b.theta_rad - a.theta_rad));
}

Pose2 interpolate(const Pose2& a, const Pose2& b, double fraction) {
  return a * Pose2::exp(fraction * (a.inverse() * b).log());
}

Eigen::Matrix3d moved_covariance(const Eigen::Matrix3d& covariance_a, const Pose2& map_from_a,
                                 const Pose2& a_from_b) {
  const Eigen::Vector2d arm = map_from_a.rotation() * a_from_b.translation();
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = -arm.y();
  jacobian(1, 2) = arm.x();
  return jacobian * covariance_a * jacobian.transpose();
}

}  // namespace beaconless
