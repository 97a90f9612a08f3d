// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "beaconless/localize/localizer.hpp"
#include "beaconless/map/map.hpp"

#include "bridges/ros1/complaints.hpp"
#include "bridges/ros1/messages.hpp"

// What the node tells, made of what it knows.
namespace beaconless::ros1 {

Transform transform_of(const Pose2& a_from_b);

/// Errors: see io::yaw_rad_of_quaternion.
Result<Pose2> pose_of(const Transform& a_from_b);

PoseMessage pose_message(const PoseEstimate& estimate, const std::string& frame);

/// The places that fit while the robot is being found, the pose itself else.
PosesMessage places_message(const PoseEstimate& estimate, std::span<const PoseCandidate> candidates,
                            const std::string& frame);

/// Where the scan's hits lie on the map; green where the pose is ok, yellow where it is degraded, red else.
///
/// In: the estimate before this one too, whose way from there tells how the robot moved during the sweep, if
/// it is within a second.
PointsMessage beams_message(const std::optional<PoseEstimate>& before, const PoseEstimate& estimate,
                            const Scan& scan, const Pose2& base_from_laser, const std::string& frame);

/// What kind of map it is, and how large.
std::string words_of_map(const Map& map);

/// How it goes, worst first: the complaints, and what the last estimate says.
DiagnosticMessage diagnostic_message(const std::optional<PoseEstimate>& estimate,
                                     const std::map<std::string, Complaints::Complaint>& complaints);

}  // namespace beaconless::ros1
