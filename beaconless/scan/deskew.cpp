// SPDX-License-Identifier: Apache-2.0
#include "beaconless/scan/deskew.hpp"

namespace beaconless {
namespace {

void points_at_once(const Scan& scan, std::vector<Eigen::Vector2d>& points) {
  points.resize(scan.hit_count());
  const std::span<const float> x_m = scan.x_m();
  const std::span<const float> y_m = scan.y_m();
  Eigen::Vector2d* to = points.data();
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam)) *to++ = {x_m[beam], y_m[beam]};
}

}  // namespace

void points_at_stamp(const Scan& scan, const Twist2& laser_twist_per_s,
                     std::vector<Eigen::Vector2d>& points) {
  points.clear();
  if (scan.size() < 2) return points_at_once(scan, points);
  const double first_s = scan.beam_time_s(0);
  const double step_s = scan.beam_time_s(1) - first_s;
  if (step_s == 0.0 || laser_twist_per_s == Twist2{}) return points_at_once(scan, points);
  // The same motion from every beam to the next: no sines in the loop.
  const Pose2 start = Pose2::exp(first_s * laser_twist_per_s);
  const Pose2 step = Pose2::exp(step_s * laser_twist_per_s);
  const double step_cos = std::cos(step.theta_rad);
  const double step_sin = std::sin(step.theta_rad);
  double x = start.x_m;
  double y = start.y_m;
  double cos = std::cos(start.theta_rad);
  double sin = std::sin(start.theta_rad);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.is_hit(beam)) {
      const Eigen::Vector2d seen = scan.point(beam);
      points.emplace_back(x + cos * seen.x() - sin * seen.y(), y + sin * seen.x() + cos * seen.y());
    }
    x += cos * step.x_m - sin * step.y_m;
    y += sin * step.x_m + cos * step.y_m;
    const double turned = cos * step_cos - sin * step_sin;
    sin = sin * step_cos + cos * step_sin;
    cos = turned;
  }
}

}  // namespace beaconless
