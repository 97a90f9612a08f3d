// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "reproduce_scenes.hpp"

namespace beaconless::cli {

/// A scan in which the map is wrong: that whose hits lie furthest from the walls of the map, on average, seen
/// from the true pose.
struct MapDisagreement {
  std::size_t scan = 0;
  double mean_m = 0.0;
  std::vector<Eigen::Vector2d> far_hits;  ///< those further than three sigmas of the range noise, map frame

  /// Where most of them lie together; the origin for none.
  Eigen::Vector2d worst_place() const;
};
MapDisagreement worst_disagreement(const Scene& scene, const FloorPlan& map);

/// A scan in which people hide corners of the room: that with the largest share hidden of the plan's corners
/// that would be seen without anybody; of several the first.
struct HiddenCorners {
  std::size_t scan = 0;
  std::vector<Eigen::Vector2d> hidden;
  std::vector<Eigen::Vector2d> seen;
  std::vector<Eigen::Vector2d> people;

  double hidden_share() const;  ///< of all that could be seen
};
HiddenCorners most_hidden_corners(const Scene& scene);

}  // namespace beaconless::cli
