// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "beaconless/event.hpp"
#include "beaconless/map/map.hpp"

namespace beaconless::trust {

/// Before which scan the localizer is told where it is: at a pose, or that it may be anywhere.
struct TrialStart {
  std::size_t scan = 0;
  std::optional<Pose2> map_from_base;
};

/// Events for a localizer, the map it gets, and where the robot truly was: one run whose every status is
/// judged.
struct Trial {
  std::string kind;    ///< what is wrong with it: "people", "mirrored", …; of recordings: "recording"
  std::string family;  ///< of the building, or the recording's name
  std::uint64_t seed = 0;
  std::shared_ptr<const Map> map;
  std::optional<FloorPlan> walls;  ///< of the map, where it is one of walls
  bool is_of_here = true;          ///< the map is that of the place, as far as it is right
  Pose2 base_from_laser;
  std::optional<double> sigma_m;  ///< of a range, where the localizer is to be told
  std::vector<TrialStart> starts;
  std::vector<Event> events;
  std::vector<Pose2> truth;  ///< of the base, one for each scan
  double reference_m = 0.0;  ///< how far the truth itself may be off
  double reference_rad = 0.0;
};

}  // namespace beaconless::trust
