// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/sim/path.hpp"

namespace beaconless::sim {

/// A robot that drives a path once, from rest to rest, and then stands at its end.
///
/// Speed rises and falls along half a cosine of kRamp_s each, so that neither speed nor acceleration jumps; a
/// way too short to reach the path's speed is driven at a lower one.
class Drive {
 public:
  static constexpr double kRamp_s = 1.0;

  explicit Drive(const Path& path);

  /// Where the base is; at the beginning of the path before 0, at its end after duration_s().
  Pose2 map_from_base(double time_s) const;

  /// Seconds from the beginning of the path to its end; 0 for a robot that stands.
  double duration_s() const { return duration_s_; }

 private:
  /// A part of the path: a way of so many metres or radians at a full speed, and the pose after a part of the
  /// way.
  struct Leg {
    double start_s = 0.0;
    double way = 0.0;
    double full_speed = 0.0;
    std::function<Pose2(double way)> pose;
  };

  void add(const Standing& path);
  void add(const Turning& path);
  void add(const Ellipse& path);
  void add(const Waypoints& path);
  void add_leg(double way, double speed, std::function<Pose2(double)> pose);
  void add_turn(const Pose2& start, double angle_rad, double rate_degps);

  std::vector<Leg> legs_;
  double duration_s_ = 0.0;
};

}  // namespace beaconless::sim
