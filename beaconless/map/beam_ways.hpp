// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// One beam as evidence: the way to its end is free, and something stands there or not.
struct BeamWay {
  Eigen::Vector2d end_map;
  bool hit;
};

/// How far beams are believed.
struct BeamReach {
  double max_range_m = 80.0;      ///< hits beyond it are not believed; the way to them is free up to here
  double no_return_free_m = 0.0;  ///< beams without return free the way up to here; 0: they say nothing
};

/// What the beams of a scan say about the map when it was taken at a pose: one way for each hit, and for each
/// beam without return if those are to speak. In: a finite pose. Cost: beams; nothing allocated once `ways`
/// has grown.
void beam_ways(const Scan& scan, const Pose2& map_from_laser, const BeamReach& reach,
               std::vector<BeamWay>& ways);

}  // namespace beaconless
