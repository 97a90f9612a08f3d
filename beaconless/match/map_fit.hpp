// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// How well the points of a scan lie on the map at one pose.
struct MapFit {
  double on_map_ratio = 0.0;  ///< share of the points within on_map_m of a surface
  double misfit = 1.0;        ///< mean squared distance, in units of on_map_m and at most 1 a point
};

/// Asks every `stride`-th point for its nearest surface. In: points in the laser frame. Cost: one nearest
/// look-up a point asked.
MapFit fit_to_map(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const Pose2& map_from_laser,
                  double on_map_m, std::size_t stride = 1);

}  // namespace beaconless
