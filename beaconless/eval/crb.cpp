// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/crb.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace beaconless::eval {
namespace {

constexpr double kLeastCosIncidence = 1e-3;
constexpr double kLeastShare = 1e-10;  // of the best known direction's information (m and rad), else rounding

}  // namespace

RangeSensor utm_30lx(double sigma_m) {
  RangeSensor sensor;
  sensor.sigma_m = sigma_m;
  for (int i = 0; i < 1081; ++i) sensor.angles_rad.push_back(radians(-135.0 + 0.25 * i));
  return sensor;
}

RangeSensor sensor_of(const Scan& scan, double sigma_m) {
  RangeSensor sensor{{}, sigma_m, scan.range_min_m(), scan.range_max_m()};
  for (std::size_t i = 0; i < scan.size(); ++i) sensor.angles_rad.push_back(scan.angle_rad(i));
  return sensor;
}

Eigen::Matrix3d fisher_information(const RayCaster& walls, const RangeSensor& sensor,
                                   const Pose2& map_from_laser) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const double angle : sensor.angles_rad) {
    const double heading = map_from_laser.theta_rad + angle;
    const Eigen::Vector2d u(std::cos(heading), std::sin(heading));
    const auto hit = walls.cast(map_from_laser.translation(), u, sensor.range_max_m);
    if (!hit || hit->range_m < sensor.range_min_m || hit->cos_incidence < kLeastCosIncidence) continue;
    const Segment2& wall = walls.segments()[hit->segment];
    const Eigen::Vector2d n(wall.b.y() - wall.a.y(),
                            wall.a.x() - wall.b.x());  // neither length nor sign matter
    const double n_u = n.dot(u);
    const double n_left = n.y() * u.x() - n.x() * u.y();
    const Eigen::Vector3d slope = Eigen::Vector3d(n.x(), n.y(), hit->range_m * n_left) / n_u;
    information += slope * slope.transpose();
  }
  return information / (sensor.sigma_m * sensor.sigma_m);
}

std::optional<Eigen::Matrix3d> accuracy_bound(const Eigen::Matrix3d& information) {
  if (!information.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  const Eigen::Vector3d& values = eigen.eigenvalues();  // ascending
  if (!(values[0] > kLeastShare * values[2])) return std::nullopt;
  const Eigen::Matrix3d half = eigen.eigenvectors() * values.cwiseSqrt().cwiseInverse().asDiagonal();
  return half * half.transpose();
}

std::optional<Eigen::Matrix3d> accuracy_bound(const RayCaster& walls, const RangeSensor& sensor,
                                              const Pose2& map_from_base, const Pose2& base_from_laser) {
  const Pose2 map_from_laser = map_from_base * base_from_laser;
  const auto bound = accuracy_bound(fisher_information(walls, sensor, map_from_laser));
  if (!bound) return std::nullopt;
  return moved_covariance(*bound, map_from_laser, base_from_laser.inverse());
}

std::vector<std::optional<Eigen::Matrix3d>> accuracy_bounds(const RayCaster& walls, const RangeSensor& sensor,
                                                            const Pose2& base_from_laser,
                                                            std::span<const PoseError> errors) {
  std::vector<std::optional<Eigen::Matrix3d>> bounds;
  bounds.reserve(errors.size());
  for (const PoseError& error : errors)
    bounds.push_back(accuracy_bound(walls, sensor, error.reference, base_from_laser));
  return bounds;
}

std::optional<CrbRatio> crb_ratio(std::span<const PoseError> errors,
                                  std::span<const std::optional<Eigen::Matrix3d>> bounds) {
  double position_m2 = 0.0;
  double heading_rad2 = 0.0;
  double position_bound_m2 = 0.0;
  double heading_bound_rad2 = 0.0;
  for (std::size_t i = 0; i < std::min(errors.size(), bounds.size()); ++i) {
    if (!bounds[i]) continue;
    position_m2 += errors[i].x_m * errors[i].x_m + errors[i].y_m * errors[i].y_m;
    heading_rad2 += errors[i].heading_rad * errors[i].heading_rad;
    position_bound_m2 += (*bounds[i])(0, 0) + (*bounds[i])(1, 1);
    heading_bound_rad2 += (*bounds[i])(2, 2);
  }
  if (!(position_bound_m2 > 0.0 && heading_bound_rad2 > 0.0)) return std::nullopt;
  return CrbRatio{std::sqrt(position_m2 / position_bound_m2), std::sqrt(heading_rad2 / heading_bound_rad2)};
}

}  // namespace beaconless::eval
