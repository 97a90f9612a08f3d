// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/event.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::trust {

/// Where a recording, and the poses of its base, are to be found.
struct RecordedSource {
  std::string log;
  std::string topic;
  std::string truth;  ///< a TUM file; empty: what each scan's own line tells
  StampIs stamp_is = StampIs::first_beam;
  Pose2 base_from_laser;
  bool truth_is_of_laser = false;  ///< else of the base
};

/// The scans of a recording whose true pose is known, and the odometry between them.
struct RecordedScans {
  std::vector<Event> events;
  std::vector<Pose2> truth;  ///< one for each scan
};

/// Errors throw BadResult.
RecordedScans read_scans(const RecordedSource& source);

/// Every scan i for which `wants(i)`; odometry stays.
template <class Wants>
RecordedScans chosen(const RecordedScans& all, const Wants& wants) {
  RecordedScans some;
  std::size_t i = 0;
  for (const Event& event : all.events) {
    if (!std::holds_alternative<Scan>(event)) {
      some.events.push_back(event);
    } else {
      if (wants(i)) {
        some.events.push_back(event);
        some.truth.push_back(all.truth[i]);
      }
      ++i;
    }
  }
  return some;
}

/// The grid of 5 cm that scans make at their true poses.
OccupancyGrid grid_of(const RecordedScans& scans, const Pose2& base_from_laser);

}  // namespace beaconless::trust
