// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/surface_map.hpp"

namespace beaconless {

/// Whether a beam would have to pass through a wall of the map, well before it ends.
///
/// In: a beam of `length_m` from a place of the map along a unit vector; walls may be off by `slack_m`: what
/// only grazes one, and would pass it that much further to either side, does not pass through. Cost: some ten
/// nearest look-ups, three times that where a wall is met. Source: sphere tracing, Hart 1996, on the distance
/// to the nearest surface.
template <SurfaceIndex Index>
bool passes_through(const Index& map, const Eigen::Vector2d& from, const Eigen::Vector2d& way,
                    double length_m, double slack_m) {
  constexpr double kThrough_m = 0.015;  // nearer than this to a surface a beam meets it …
  constexpr double kBefore_m = 0.12;    // … if it ends this far behind: no noise, and no wall that is off
  constexpr double kStart_m = 0.1;      // from the laser
  const double end_m = length_m - std::max(kBefore_m, 4.0 * slack_m);
  const auto is_met = [&](const Eigen::Vector2d& origin) {
    for (double at_m = kStart_m; at_m < end_m;) {
      const auto surface = map.nearest(origin + at_m * way);
      const double clear_m = surface ? surface->distance_m : map.reach_m();
      if (clear_m < kThrough_m) return true;
      at_m += clear_m;
    }
    return false;
  };
  if (!is_met(from)) return false;
  if (slack_m == 0.0) return true;
  const Eigen::Vector2d aside(-slack_m * way.y(), slack_m * way.x());
  return is_met(from + aside) && is_met(from - aside);
}

/// The share of a scan's beams that would have to pass through a wall of the map: hardly any where the laser
/// truly is, whatever stands around it, since people and new things only shorten beams.
///
/// In: ends of beams in the laser frame, from `first` on every `stride`-th of which is followed; `slack_m` as
/// above. 0 for no points.
double see_through_share(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                         const Pose2& map_from_laser, std::size_t stride, double slack_m = 0.0,
                         std::size_t first = 0);

}  // namespace beaconless
