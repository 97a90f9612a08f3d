// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// What the wheels (or another dead reckoning) say. Drifts; only differences mean something.
struct Odometry {
  Stamp stamp;
  Pose2 odom_from_base;
  std::optional<Twist2> twist_per_s;  ///< in the base frame, where the source tells it
  std::string source;                 ///< topic, or keyword of the log line

  friend bool operator==(const Odometry&, const Odometry&) = default;
};

/// Where somebody else says the robot was: a reflector system, motion capture, the pose field of a log, the
/// simulator.
struct ReferencePose {
  Stamp stamp;
  Pose2 map_from_base;
  std::optional<Pose2> base_from_laser;  ///< where the source tells laser and robot pose apart
  std::string source;                    ///< topic, or keyword of the log line

  friend bool operator==(const ReferencePose&, const ReferencePose&) = default;
};

/// Everything that happens to a robot. The one way in.
using Event = std::variant<Scan, Odometry, ReferencePose>;

inline Stamp stamp_of(const Event& event) {
  return std::visit(
      [](const auto& e) {
        if constexpr (requires { e.stamp(); })
          return e.stamp();
        else
          return e.stamp;
      },
      event);
}

}  // namespace beaconless
