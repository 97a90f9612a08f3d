// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/event.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// A complete pipeline on a known map: events in, estimates out.
class Localizer {
 public:
  virtual ~Localizer() = default;

  /// Sets the belief: the robot's base stands about here now.
  virtual void start_at(const Pose2& map_from_base) = 0;

  /// Takes in one event. Total: any event in any state gives an estimate with a status, and no NaN.
  virtual PoseEstimate update(const Event& event) = 0;
};

}  // namespace beaconless
