// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/event.hpp"
#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/sim/lidar.hpp"
#include "beaconless/sim/path.hpp"
#include "beaconless/sim/world.hpp"

namespace beaconless::sim {

/// Everything that a simulated recording follows from.
struct Scenario {
  std::string name;
  std::string description;
  FloorPlan plan;
  std::vector<Person> people;
  LidarConfig lidar;
  Path path = Standing{};
  double duration_s = 10.0;
  Pose2 base_from_laser{0.7, 0.0, 0.0};  ///< the dissertation's robot, 4.1
  int seed = 1;

  /// Sweeps begin at 0, 1 / rate, 2 / rate, … before duration_s.
  std::size_t sweep_count() const;

  friend bool operator==(const Scenario&, const Scenario&) = default;
};

void describe(Fields& fields, Scenario& scenario);  ///< duration_s, seed, lidar.*

/// Done, or the first thing that keeps the scenario from being run: a field out of its range, a person or a
/// drive without waypoints, a scanner that sees nothing.
Result<Done> check(const Scenario& scenario);

/// One sweep as it was measured, and where the base truly was at its stamp (that of the first beam).
struct Sample {
  RawScan scan;
  Pose2 map_from_base;
};

/// Runs a scenario and hands over one sample after the other; memory does not grow.
///
/// Errors: those of `check`. The same scenario gives the same bits.
Result<Done> simulate(const Scenario& scenario, const std::function<void(const Sample&)>& on_sample);

/// A run in memory.
struct SimulatedRun {
  std::vector<Event> events;  ///< all of them Scan
  Trajectory truth;           ///< of the base, one pose for each scan, at its stamp
};

/// Runs a scenario and keeps everything: about 14 kB a sweep of 1081 beams. Errors: as above.
Result<SimulatedRun> simulate(const Scenario& scenario);

}  // namespace beaconless::sim
