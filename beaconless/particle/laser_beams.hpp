// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// Where some beams end, in the laser frame: a list a coordinate, for loops over them.
struct BeamEnds {
  std::vector<float> x_m;
  std::vector<float> y_m;
  std::size_t size() const { return x_m.size(); }
};

/// Takes `most` of the points at most, evenly among them; all where there are no more.
void choose_ends(std::span<const Eigen::Vector2d> points, int most, BeamEnds& ends);

/// A whole beam.
struct CastBeam {
  Eigen::Vector2d direction;  ///< unit, laser frame
  double range_m = 0.0;
  bool is_hit = true;  ///< false: nothing came back from within range_m
};

/// Takes `most` of a scan's beams at most, evenly among those that hit something or found the way free.
///
/// In: `reach_m`, which longer ranges and beams without a return are cut to. Differs: ROS's amcl steps by
/// (beams - 1) / (most - 1), which is 0 where there are fewer beams and then never ends.
void choose_beams(const Scan& scan, int most, double reach_m, std::vector<CastBeam>& beams);

}  // namespace beaconless
