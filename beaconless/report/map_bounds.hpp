// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Geometry>

#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/map/map.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::report {

/// The part of the plane that a picture of a run should show, in the map frame; never empty.
///
/// All of the map's obstacles, and the poses that lie within half of its size around it: a robot that lost
/// itself a kilometre away shall not shrink the building to a dot. Without a map, all poses. Coordinates
/// beyond ±1e7 m are passed over.
Eigen::AlignedBox2d bounds_of_run(const Map& map, std::span<const PoseEstimate> estimates,
                                  const Trajectory& reference);

}  // namespace beaconless::report
