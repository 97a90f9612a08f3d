// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"

namespace beaconless::sim {

/// The base does not move.
struct Standing {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_deg = 0.0;

  friend bool operator==(const Standing&, const Standing&) = default;
};

/// The base turns in place.
struct Turning {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_deg = 0.0;  ///< at the beginning
  double angle_deg = 360.0;  ///< negative: clockwise
  double rate_degps = 45.0;

  friend bool operator==(const Turning&, const Turning&) = default;
};

/// The base drives around an ellipse, nose along the path.
struct Ellipse {
  double center_x_m = 0.0;
  double center_y_m = 0.0;
  double semi_axis_x_m = 2.0;
  double semi_axis_y_m = 1.0;
  double heading_deg = 0.0;  ///< of the ellipse's own x axis in the map
  double start_deg =
      0.0;             ///< eccentric anomaly at the beginning: 0 on the ellipse's x axis, 90 on its y axis
  double turns = 1.0;  ///< negative: clockwise
  double speed_mps = 0.5;

  friend bool operator==(const Ellipse&, const Ellipse&) = default;
};

/// The base drives straight from point to point and turns in place at each.
struct Waypoints {
  std::vector<Eigen::Vector2d> points;
  double speed_mps = 0.5;
  double rate_degps = 45.0;

  friend bool operator==(const Waypoints&, const Waypoints&) = default;
};

using Path = std::variant<Standing, Turning, Ellipse, Waypoints>;

void describe(Fields& fields, Standing& path);
void describe(Fields& fields, Turning& path);
void describe(Fields& fields, Ellipse& path);
void describe(Fields& fields, Waypoints& path);  ///< all but the points

}  // namespace beaconless::sim
