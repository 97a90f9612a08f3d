// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// The share of a scan's beams that would have to pass through a wall of the map, well before they end:
/// hardly any where the laser truly is, whatever stands around it, since people and new things only shorten
/// beams.
///
/// In: ends of beams in the laser frame, every `stride`-th of which is followed. 0 for no points. Cost: some
/// ten nearest look-ups a beam. Source: sphere tracing, Hart 1996, on the distance to the nearest surface.
double see_through_share(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                         const Pose2& map_from_laser, std::size_t stride);

}  // namespace beaconless
