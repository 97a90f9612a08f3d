// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// Gives an estimate the protection level of the fit that it was made from, carried from the laser to the
/// base.
///
/// In: an estimate that is complete but for it; what its covariance has beyond the fit's (the motion during
/// the sweep, a weak fit, places that fit as well) counts with as many standard deviations as the risk asks
/// for. Unbounded where the fit is: by methods that tell none, where a direction is open, where the robot is
/// lost or being found, and where `is_elsewhere`: beams would have to pass through walls.
void protect(PoseEstimate& estimate, const MatchResult& fit, const Pose2& laser_from_base, double risk,
             bool is_elsewhere);

}  // namespace beaconless
