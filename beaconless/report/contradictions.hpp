// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/map/map.hpp"
#include "beaconless/report/map_view.hpp"

namespace beaconless::report {

/// Less may be noise, a pose that is a little off, or a wall that was drawn carelessly.
inline constexpr double kContradicts_m = 0.3;

/// Ends of beams that the map does not explain, map frame.
struct Contradictions {
  std::vector<Eigen::Vector2d> new_things;     ///< the way there is free, and the map has nothing near it
  std::vector<Eigen::Vector2d> missing_walls;  ///< the way there leads through a wall
  std::size_t beam_count = 0;                  ///< of all hits
};

/// Finds where scans and map disagree by `kContradicts_m` or more.
///
/// In: scans at poses that are right. Whatever moves shows among the new things; walls that were taken away
/// or stand elsewhere, and glass, among the missing ones. A map without surfaces explains nothing: none.
/// Cost: builds the map's index, then some ten look-ups a beam.
Contradictions find_contradictions(const Map& map, std::span<const PlacedScan> scans);

}  // namespace beaconless::report
