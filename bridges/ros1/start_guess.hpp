// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/map/map.hpp"

#include "bridges/ros1/messages.hpp"

namespace beaconless::ros1 {

/// Where somebody thinks the robot is.
struct StartGuess {
  Pose2 map_from_base;
  std::optional<SearchRegion> within;  ///< where the guess is too wide to start at: look here
};

/// Judges a pose that came in from outside, as by /initialpose.
///
/// A guess good to 1 m and 45° (one sigma) is a pose to start at; a wider one, up to 100 m, a disc of three
/// sigmas to search, heading unknown; one without any covariance, as typed by hand, is a pose. Errors:
/// another frame, numbers that are not finite or no place on a map, a quaternion of length zero, a covariance
/// that is none or says nothing. Source: the failure of nav2's amcl on a huge covariance (navigation2#5611).
Result<StartGuess> start_guess_of(const PoseMessage& pose, const std::string& global_frame);

/// Whether a guess may be a place on that map. Errors: its region, or all that a laser at its pose could see
/// (100 m), lies off the box around the walls. Cost: that of wall_box.
Result<Done> check_on_map(const StartGuess& guess, const Map& map);

}  // namespace beaconless::ros1
