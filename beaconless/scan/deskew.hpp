// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// The ends of all beams that hit something, as seen from where the laser was at the scan's stamp while it
/// moved on with a constant twist.
///
/// In: the laser's twist per second in its own frame at the stamp. Out: laser frame at the stamp; what was in
/// `points` is replaced. Cost: one multiplication of poses a beam; none where the scan tells no time per beam
/// or the laser stands still. Source: the motion of a constant twist, Pose2::exp.
void points_at_stamp(const Scan& scan, const Twist2& laser_twist_per_s, std::vector<Eigen::Vector2d>& points);

}  // namespace beaconless
