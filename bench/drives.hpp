// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "beaconless/event.hpp"
#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless::bench {

/// Scans in memory, where they were taken, and the floor plan around them.
struct Drive {
  std::string name;
  FloorPlan plan;
  Pose2 base_from_laser;
  std::vector<RawScan> raw_scans;  ///< of simulated drives only
  std::vector<Event> scans;
  Trajectory truth;  ///< of the base, one pose for each scan

  const Scan& scan(std::size_t i) const { return std::get<Scan>(scans[i]); }
  Pose2 map_from_laser(std::size_t i) const { return truth[i].pose * base_from_laser; }
};

/// A scenario of data/scenarios. Throws BadResult where it cannot be read.
Drive simulated_drive(const std::string& scenario);

/// A recording, its floor plan and the true poses of its laser (NAME.carmen.log.gz, NAME.truth.tum) below the
/// folder that the environment variable BEACONLESS_DATA names; nothing where they are absent.
std::optional<Drive> recorded_drive(const std::string& name, const std::string& plan);

/// A file below that folder; empty where it is absent.
std::string recorded_file(const std::string& name);

/// The grid that a drive's own scans make at their true poses.
OccupancyGrid grid_of(const Drive& drive, double resolution_m);

/// What the laser hit, in its own frame.
std::vector<Eigen::Vector2d> points_of(const Scan& scan);

}  // namespace beaconless::bench
