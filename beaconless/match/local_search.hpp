// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/match/lattice_search.hpp"

namespace beaconless {

/// The window around a guess that is searched when the guess alone leads nowhere.
struct LocalSearchConfig {
  double window_m = 1.2;
  double window_deg = 50.0;
  double cell_m = 0.05;  ///< distance between starts, and size of the cells of the map that is searched in
  double step_deg = 2.5;
  int points = 80;            ///< of the scan, evenly taken
  double truncate_m = 0.2;    ///< a point further from every wall than this says no more than "not here"
  double far_penalty = 0.05;  ///< cost of a start at the window's edge, as a share of the worst cost
  int lost_stride = 4;        ///< a lost robot searches a wider window with every so many scans
  int keep = 4;               ///< best starts to return
};

void describe(Fields& fields, LocalSearchConfig& config);

/// Buffers that live on from call to call, so that a search allocates nothing.
struct LocalSearchScratch {
  std::vector<Eigen::Vector2d> points;
  LatticeScratch lattice;
};

/// Scores every pose of a window around a guess by how near the scan's points fall to the map, and gives the
/// best ones, best first, no two of them neighbours.
///
/// In: points in the laser frame; a map of the config's `cell_m` and `truncate_m`; a finite guess. Cost: that
/// of search_lattice(). Source: Olson, "Real-time correlative scan matching", 2009. Differs: truncated
/// squared distances instead of a blurred image.
void search_around(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map, const Pose2& guess,
                   const LocalSearchConfig& config, LocalSearchScratch& scratch,
                   std::vector<StartPose>& starts);

}  // namespace beaconless
