// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/map/ray_caster.hpp"

namespace beaconless::sim {

/// Someone who walks to and fro between waypoints and is on no map: a disc at the height of the laser.
struct Person {
  double radius_m = 0.2;
  double speed_mps = 1.2;
  double start_s = 0.0;                    ///< stands at the first waypoint until then
  std::vector<Eigen::Vector2d> waypoints;  ///< to the last one and back again, for ever

  /// Where the middle of the disc is; the origin when there are no waypoints.
  Eigen::Vector2d position_m(double time_s) const;

  friend bool operator==(const Person&, const Person&) = default;
};

void describe(Fields& fields, Person& person);  ///< all but the waypoints

/// A flat world: walls that stand and people who walk.
class World {
 public:
  World(const FloorPlan& plan, std::vector<Person> people);

  /// Metres to the first thing a ray meets at a moment, at most `max_range_m`; nothing where the way is free,
  /// 0 from inside a person.
  std::optional<double> range_m(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                double max_range_m, double time_s) const;

  const RayCaster& walls() const { return walls_; }
  const std::vector<Person>& people() const { return people_; }

 private:
  RayCaster walls_;
  std::vector<Person> people_;
};

}  // namespace beaconless::sim
