// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/sweep_twist.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include <Eigen/LU>

#include "beaconless/match/robust_loss.hpp"

namespace beaconless {
namespace {

constexpr double kCut = 4.685;       // of Tukey's weights, in standard deviations
constexpr double kLeastCos2 = 0.03;  // beams that graze a wall more know no more
constexpr int kLeastBeams = 30;
constexpr double kMoreThanNoise = 1.2;  // a variance of so much more is not the laser's alone

}  // namespace

std::optional<SweepTwist> twist_of_sweep(std::span<const Eigen::Vector2d> points,
                                         std::span<const double> times_s, const SurfaceMap& map,
                                         const Pose2& map_from_laser, const SweepNoise& noise) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  if (points.empty() || points.size() != times_s.size()) return std::nullopt;
  const auto [first, last] = std::minmax_element(times_s.begin(), times_s.end());
  const double duration_s = *last - *first;
  if (!(duration_s > 0.0)) return std::nullopt;
  const Eigen::Matrix2d rotation = map_from_laser.rotation();
  const double own_m2 = noise.sigma_m * noise.sigma_m;
  const double told_m2 = own_m2 + noise.map_sigma_m * noise.map_sigma_m;
  const double scale_m2 = noise.scale_m * noise.scale_m;
  const double spread_m2 = scale_m2 > kMoreThanNoise * told_m2 ? scale_m2 : told_m2;
  const double off_m2 = spread_m2 - own_m2;
  const double spread_m = std::sqrt(spread_m2);
  // 1. Pose and twist, whatever moves the beams nearer to their walls.
  Matrix6 information = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double arms_m2 = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d arm = rotation * points[i];
    const Eigen::Vector2d end = map_from_laser.translation() + arm;
    const auto surface = std::visit([&](const auto& index) { return index.nearest(end); }, map);
    if (!surface) continue;
    const Eigen::Vector2d normal = rotation.transpose() * surface->normal;  // laser frame
    const double e = surface->normal.dot(end - surface->point);
    const double share = e / (kCut * spread_m);
    if (std::abs(share) >= 1.0) continue;
    const double left = 1.0 - share * share;
    const double cos = normal.dot(points[i]);
    const double cos2 = std::max(kLeastCos2, cos * cos / std::max(points[i].squaredNorm(), 1e-12));
    const double weight = left * left / (own_m2 * cos2 + off_m2);
    const double turned = normal.y() * points[i].x() - normal.x() * points[i].y();
    const double time = (times_s[i] - *first) / duration_s - 0.5;
    Vector6 slope;
    slope << normal, turned, time * normal, time * turned;
    information += weight * slope * slope.transpose();
    gradient += weight * e * slope;
    arms_m2 += points[i].squaredNorm();
    ++count;
  }
  if (count < kLeastBeams) return std::nullopt;
  // 2. What of the twist is left when the pose may be anything.
  const Eigen::Matrix3d across = information.topRightCorner<3, 3>();
  const Eigen::FullPivLU<Eigen::Matrix3d> pose(information.topLeftCorner<3, 3>());
  if (!pose.isInvertible()) return std::nullopt;
  const Eigen::Matrix3d reduced = across.transpose() * pose.inverse();
  const Eigen::FullPivLU<Eigen::Matrix3d> twist(
      Eigen::Matrix3d(information.bottomRightCorner<3, 3>() - reduced * across));
  if (!twist.isInvertible()) return std::nullopt;
  const Eigen::Vector3d step = -twist.inverse() * (gradient.tail<3>() - reduced * gradient.head<3>());
  // 3. Per second, and what walls that are off make of it: they do not average out over their beams.
  SweepTwist told;
  told.correction_per_s = step / duration_s;
  const double off_per_s2 = 12.0 * off_m2 / (duration_s * duration_s);
  told.covariance = twist.inverse() / (duration_s * duration_s);
  told.covariance.diagonal() +=
      off_per_s2 * Eigen::Vector3d(1.0, 1.0, static_cast<double>(count) / std::max(arms_m2, 1e-6));
  if (!told.correction_per_s.allFinite() || !told.covariance.allFinite()) return std::nullopt;
  return told;
}

}  // namespace beaconless
