// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::eval {

/// The points that a detector found in one scan, sensor frame, and where the scan was truly taken.
struct View {
  const Scan* scan = nullptr;
  Pose2 map_from_laser;
  std::span<const Eigen::Vector2d> points;
};

/// What counts as the same point, and as visible.
struct RepeatabilityConfig {
  double within_m = 0.1;     ///< the same point again
  double occluded_m = 0.15;  ///< a point this far behind what the other scan sees there is not visible
};

/// How well the points of earlier scans were found again in later ones; sums over pairs of scans.
struct Repeatability {
  std::size_t pair_count = 0;       ///< pairs of scans
  std::size_t point_count = 0;      ///< points of the earlier scans, visible or not
  std::size_t visible_count = 0;    ///< those of them that the later scan can see
  std::size_t found_count = 0;      ///< those with a point of the later scan within `within_m`
  std::size_t common_count = 0;     ///< the lesser of the two visible counts, a pair
  std::size_t matched_count = 0;    ///< points paired one to one, each the other's nearest
  std::vector<double> distances_m;  ///< of the found points

  double found_ratio() const;    ///< found / visible: a point of scan k is found again in scan k + gap
  double matched_ratio() const;  ///< matched / common, as in the papers on FALKO and FLIRT
  double points_per_scan() const;
  double mean_distance_m() const;
  double rms_distance_m() const;
};

/// Compares each view with the one `gap` later.
///
/// A point is visible in the other scan when it lies within its field of view and range limits, and a beam
/// next to its bearing reaches it or gives no range. Cost: views x points². Source: Kallasi, Lodi Rizzini and
/// Caselli 2016, section V; Tipaldi and Arras 2010, section IV. Differs: visibility comes from the scan
/// itself, so that no map is needed; the strict ratio (all visible points of the earlier scan) stands beside
/// theirs.
Repeatability repeatability(std::span<const View> views, std::size_t gap,
                            const RepeatabilityConfig& config = {});

}  // namespace beaconless::eval
