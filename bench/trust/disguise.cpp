// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/disguise.hpp"

#include <cmath>
#include <limits>

#include "beaconless/geometry/angle.hpp"

namespace beaconless::trust {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr double kElbow_m = 0.35;  // people step aside before the laser is nearer than this

Eigen::Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// A disc as it moves during one sweep.
struct MovingDisc {
  Eigen::Vector2d at;
  Eigen::Vector2d per_s;
  double radius_m;
};

std::vector<MovingDisc> discs_of(std::span<const Bystander> people, const Pose2& laser, double time_s) {
  std::vector<MovingDisc> discs;
  for (const Bystander& person : people) {
    constexpr double kSoon_s = 0.02;
    const Eigen::Vector2d now = person.position_m(time_s, laser.translation());
    const Eigen::Vector2d soon = person.position_m(time_s + kSoon_s, laser.translation());
    if ((now - laser.translation()).norm() > person.radius_m + kElbow_m)
      discs.push_back({now, (soon - now) / kSoon_s, person.radius_m});
  }
  return discs;
}

/// Where a ray enters the nearest disc; infinity where it meets none.
double range_to(std::span<const MovingDisc> discs, double later_s, const Eigen::Vector2d& origin,
                const Eigen::Vector2d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const MovingDisc& disc : discs) {
    const Eigen::Vector2d to = disc.at + later_s * disc.per_s - origin;
    const double ahead = direction.dot(to);
    const double square = ahead * ahead - to.squaredNorm() + disc.radius_m * disc.radius_m;
    if (ahead > 0.0 && square >= 0.0) nearest = std::min(nearest, ahead - std::sqrt(square));
  }
  return nearest;
}

bool is_glass(std::span<const Glass> pieces, const Eigen::Vector2d& point) {
  for (const Glass& glass : pieces)
    if ((point - glass.middle).squaredNorm() < glass.radius_m * glass.radius_m) return true;
  return false;
}

}  // namespace

Eigen::Vector2d Bystander::position_m(double time_s, const Eigen::Vector2d& robot) const {
  const Eigen::Vector2d swayed = at + std::sin(2.0 * kPi * time_s / period_s + phase_rad) * sway;
  return follows ? Eigen::Vector2d(robot + swayed) : swayed;
}

std::vector<Bystander> make_crowd(double share, const sim::LidarConfig& lidar,
                                  const sim::LaserMotion& map_from_laser, double time_s, Rng& rng) {
  constexpr std::size_t kMost = 60;
  const Pose2 laser = map_from_laser(time_s);
  RawScan empty{.stamp = Stamp::from_seconds(time_s)};
  empty.angle_min_rad = static_cast<float>(radians(lidar.angle_min_deg));
  empty.angle_increment_rad = static_cast<float>(lidar.angle_step_rad());
  Disguise crowd;
  for (double hidden = 0.0; hidden < share && crowd.people.size() < kMost;) {
    Bystander person;
    person.follows = rng.uniform() < 0.6;
    const Eigen::Vector2d from_laser =
        rng.uniform(0.7, 3.0) *
        unit(laser.theta_rad + radians(rng.uniform(lidar.angle_min_deg, lidar.angle_max_deg)));
    person.at = person.follows ? from_laser : Eigen::Vector2d(laser.translation() + from_laser);
    person.sway = rng.uniform(0.0, person.follows ? 0.3 : 2.0) * unit(rng.uniform(-kPi, kPi));
    person.period_s = rng.uniform(3.0, 12.0);
    person.phase_rad = rng.uniform(-kPi, kPi);
    person.radius_m = rng.uniform(0.15, 0.3);
    crowd.people.push_back(person);
    RawScan seen = empty;
    seen.ranges_m.assign(static_cast<std::size_t>(lidar.beam_count), kNoReturn);
    Rng unheard(1);
    hidden = hide(seen, crowd, lidar, map_from_laser, unheard);
  }
  return crowd.people;
}

std::vector<Glass> make_glass(const Building& building, int pieces, Rng& rng) {
  const std::vector<Segment2> walls = FloorPlan{.walls = building.walls}.segments();
  double length = 0.0;
  for (const Segment2& wall : walls) length += (wall.b - wall.a).norm();
  std::vector<Glass> glass;
  for (int i = 0; i < pieces; ++i) {
    double along = rng.uniform(0.0, length);
    for (const Segment2& wall : walls) {
      const double wall_m = (wall.b - wall.a).norm();
      if (along < wall_m) {
        glass.push_back({wall.a + along / wall_m * (wall.b - wall.a), rng.uniform(0.6, 3.0)});
        break;
      }
      along -= wall_m;
    }
  }
  return glass;
}

double hide(RawScan& scan, const Disguise& disguise, const sim::LidarConfig& lidar,
            const sim::LaserMotion& map_from_laser, Rng& rng) {
  if (disguise.people.empty() && disguise.glass.empty()) return 0.0;
  const double time_s = scan.stamp.seconds();
  Pose2 laser = map_from_laser(time_s);
  const std::vector<MovingDisc> discs = discs_of(disguise.people, laser, time_s);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double later_s = static_cast<double>(i) * lidar.beam_time_s();
    if (lidar.beam_time_s() > 0.0) laser = map_from_laser(time_s + later_s);
    const double bearing = static_cast<double>(scan.angle_min_rad) +
                           static_cast<double>(i) * static_cast<double>(scan.angle_increment_rad);
    const Eigen::Vector2d direction = unit(laser.theta_rad + bearing);
    float& range = scan.ranges_m[i];
    if (std::isfinite(range) &&
        is_glass(disguise.glass, laser.translation() + static_cast<double>(range) * direction))
      range = kNoReturn;
    const double person = range_to(discs, later_s, laser.translation(), direction);
    if (!(person < static_cast<double>(range))) continue;
    range = static_cast<float>(person + rng.normal(lidar.range_sigma_m));
    ++hidden;
  }
  return static_cast<double>(hidden) / static_cast<double>(scan.ranges_m.size());
}

}  // namespace beaconless::trust
