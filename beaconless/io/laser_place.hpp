// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/frame_transform.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Where a laser sits on the robot, by the transforms that never change: up from its frame to a base.
///
/// The base is the first of `bases` on that way, in their order. Nothing where the way leads to none. Errors:
/// the laser is tilted by more than 15° or hangs upside down, so that the plane has no pose for it.
Result<std::optional<LaserPlace>> laser_place(const std::vector<FrameTransform>& fixed,
                                              const std::string& laser_frame,
                                              const std::vector<std::string>& bases);

}  // namespace beaconless::io
