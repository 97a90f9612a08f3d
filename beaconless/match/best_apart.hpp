// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// Appends the best of the poses that were tried on a lattice, best first, leaving out neighbours of better
/// ones, until there are `keep`. Sorts `tried`; each has a member map_from_laser.
template <class Tried, class IsBetter>
void keep_best_apart(std::vector<Tried>& tried, double step_m, double step_deg, int keep,
                     const IsBetter& is_better, std::vector<Tried>& kept) {
  std::sort(tried.begin(), tried.end(), is_better);
  for (const Tried& pose : tried) {
    const bool is_neighbour = std::any_of(kept.begin(), kept.end(), [&](const Tried& better) {
      return distance_m(pose.map_from_laser, better.map_from_laser) < 1.6 * step_m &&
             heading_difference_rad(pose.map_from_laser, better.map_from_laser) < radians(2.1 * step_deg);
    });
    if (!is_neighbour) kept.push_back(pose);
    if (kept.size() == static_cast<std::size_t>(keep)) break;
  }
}

/// Takes about `count` of the points, evenly.
inline void thin(std::span<const Eigen::Vector2d> points, int count, std::vector<Eigen::Vector2d>& few) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / static_cast<std::size_t>(count));
  few.clear();
  for (std::size_t i = stride / 2; i < points.size(); i += stride) few.push_back(points[i]);
}

}  // namespace beaconless
