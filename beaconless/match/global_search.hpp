// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/floor_plan.hpp"
#include "beaconless/match/lattice_search.hpp"

namespace beaconless {

/// How a robot that may be anywhere is looked for.
struct GlobalSearchConfig {
  double cell_m = 0.1;      ///< distance between poses, and size of the cells of the map that is searched in
  double step_deg = 1.0;    ///< angle between headings
  double truncate_m = 0.4;  ///< a point further from every wall than this says no more than "not here"
  int points = 120;         ///< of the scan, evenly taken
  int keep = 24;            ///< best places to return …
  double hopeless = 0.15;   ///< … whose cost is at most so much above the best
  int threads = 1;          ///< that share the work; the places are the same bits with any number
};

void describe(Fields& fields, GlobalSearchConfig& config);

/// Buffers that live on from call to call.
struct GlobalSearchScratch {
  std::vector<Eigen::Vector2d> points;
  LatticeScratch lattice;
};

/// The places of a box of the map, at any heading, where a scan's points fall nearest to the map's surfaces:
/// at least 0.5 m or 10° apart, best first.
///
/// In: ends of beams in the laser frame; the map by cells of `config.cell_m`; a box in the map frame that the
/// laser is in. Exact on the lattice of poses, see search_lattice(). Cost: that of search_lattice() for the
/// box and all headings. Source: Olson, ICRA 2009 (a scan against a smeared map); Hess et al., ICRA 2016.
void search_everywhere(std::span<const Eigen::Vector2d> points, const NearnessPyramid& map,
                       const FloorPlan::Bounds& box, const GlobalSearchConfig& config,
                       GlobalSearchScratch& scratch, std::vector<StartPose>& places);

}  // namespace beaconless
