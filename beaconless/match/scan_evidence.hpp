// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// What the beams of a scan say for and against a pose.
struct ScanEvidence {
  double on_map = 0.0;    ///< share that ends on a surface of the map
  double in_front = 0.0;  ///< share that ends where nothing is drawn: something new stands there
  double through = 0.0;   ///< share that passes through a surface: a wall is gone, or the pose is wrong
  double log_likelihood = -10.0;  ///< mean of a beam; 0 where all end on the middle of surfaces

  friend bool operator==(const ScanEvidence&, const ScanEvidence&) = default;
};

/// Weighs a scan at a pose, by about `beams` of its beams, evenly taken.
///
/// In: ends of beams in the laser frame; `sigma_m`, by how much surfaces and beams may be off. A beam is a
/// mixture: on a surface (a Gaussian of its distance), ended early by something that is not in the map, or,
/// hardly ever, through a surface. Cost: some ten nearest look-ups a beam. Source: Thrun, Burgard, Fox,
/// "Probabilistic Robotics", 2005, 6.3 (the mixture of the beam model). Differs: the distance of the end to
/// the nearest surface instead of along the beam, and the mean instead of the sum: neighbouring beams are not
/// independent.
ScanEvidence weigh_scan(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                        const Pose2& map_from_laser, double sigma_m, std::size_t beams);

}  // namespace beaconless
