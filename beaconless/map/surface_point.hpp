// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <optional>

#include <Eigen/Core>

namespace beaconless {

/// The place on the map's surfaces that lies nearest to some point.
struct SurfacePoint {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit length, either side
  double distance_m = 0.0;
};

/// Anything that can answer "which surface is nearest to here?" in constant time and without allocating.
///
/// `nearest(p)` gives nothing where every surface is further than the reach the index was built for.
template <class Index>
concept SurfaceIndex = requires(const Index& index, const Eigen::Vector2d& point) {
  { index.nearest(point) } -> std::same_as<std::optional<SurfacePoint>>;
  { index.reach_m() } -> std::convertible_to<double>;
};

}  // namespace beaconless
