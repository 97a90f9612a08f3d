// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/world.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless::sim {
namespace {

/// Where a ray enters a disc; 0 when it starts inside.
std::optional<double> enter_disc(const Eigen::Vector2d& to_center, const Eigen::Vector2d& direction,
                                 double radius_m) {
  const double square = to_center.squaredNorm() - radius_m * radius_m;
  if (square <= 0.0) return 0.0;
  const double ahead = direction.dot(to_center);
  const double discriminant = ahead * ahead - square;
  if (ahead <= 0.0 || discriminant < 0.0) return std::nullopt;
  return square / (ahead + std::sqrt(discriminant));
}

}  // namespace

Eigen::Vector2d Person::position_m(double time_s) const {
  if (waypoints.empty()) return Eigen::Vector2d::Zero();
  double length = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) length += (waypoints[i] - waypoints[i - 1]).norm();
  const double walked = speed_mps * (time_s - start_s);
  if (!(length > 0.0) || !(walked > 0.0)) return waypoints.front();

  double along = std::fmod(walked, 2.0 * length);
  if (along > length) along = 2.0 * length - along;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const double leg = (waypoints[i] - waypoints[i - 1]).norm();
    if (along <= leg && leg > 0.0) return waypoints[i - 1] + along / leg * (waypoints[i] - waypoints[i - 1]);
    along -= leg;
  }
  return waypoints.back();
}

void describe(Fields& fields, Person& person) {
  fields("radius_m", person.radius_m, {0.01, 10}, "of the disc that the laser sees");
  fields("speed_mps", person.speed_mps, {0, 100}, "how fast the person walks");
  fields("start_s", person.start_s, {-86400, 86400}, "when the person leaves the first waypoint");
}

World::World(const FloorPlan& plan, std::vector<Person> people)
    : walls_(plan.segments()), people_(std::move(people)) {}

std::optional<double> World::range_m(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                     double max_range_m, double time_s) const {
  const auto wall = walls_.cast(origin, direction, max_range_m);
  std::optional<double> nearest;
  if (wall) nearest = wall->range_m;
  for (const Person& person : people_) {
    const auto entry = enter_disc(person.position_m(time_s) - origin, direction, person.radius_m);
    if (entry && *entry <= nearest.value_or(max_range_m)) nearest = entry;
  }
  return nearest;
}

}  // namespace beaconless::sim
