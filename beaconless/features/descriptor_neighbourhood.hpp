// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// How far around a keypoint a descriptor looks: radius = radius_m * exp(growth_per_m * range).
///
/// The radius is metric by default, so that a corner looks the same from 2 m and from 10 m. A growth lets far
/// neighbourhoods hold as many beams as near ones, which detectors need; a descriptor pays for it by showing
/// another piece of the world from elsewhere. FALKO's neighbourhoods are {0.1, 0.07}.
struct NeighbourhoodConfig {
  double radius_m = 0.5;
  double growth_per_m = 0.0;

  double radius_at(double range_m) const {
    return growth_per_m == 0.0 ? radius_m : radius_m * std::exp(growth_per_m * range_m);
  }
};

void describe(Fields& fields, NeighbourhoodConfig& config);

/// The beams whose bearings can bring them within a radius of a point: at most two runs of the arrays. Hits
/// and others; distances are the caller's business.
struct BeamWindow {
  std::array<ScanSegment, 2> runs;  ///< none runs over the end of the arrays

  std::size_t count() const { return runs[0].count + runs[1].count; }
};

/// Finds the window of all beams that pass within `radius_m` of a point (sensor frame) in front of the
/// sensor.
///
/// Everything when the sensor itself lies within the radius; nothing where the point lies outside the field
/// of view by more than the radius. Neighbourhoods run over the end of a full circle, and over a gap of the
/// field of view that is narrower than they are. Cost: one arc tangent and one arc sine. Differs: falkolib
/// takes asin of more than 1 when the radius exceeds the range, and its window is one beam longer at one
/// end; flirtlib's has the arc tangent in the place of the arc sine, which is too narrow.
BeamWindow beams_around(const Scan& scan, const Eigen::Vector2d& point, double radius_m);

}  // namespace beaconless
