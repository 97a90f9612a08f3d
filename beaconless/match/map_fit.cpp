// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/map_fit.hpp"

#include <algorithm>

namespace beaconless {
namespace {

template <SurfaceIndex Index>
MapFit fit(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& pose, double on_map_m,
           std::size_t stride) {
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d origin = pose.translation();
  double near = 0.0;
  int on_map = 0;
  int asked = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++asked) {
    const auto surface = map.nearest(origin + rotation * points[i]);
    if (!surface || surface->distance_m > on_map_m) continue;
    const double share = surface->distance_m / on_map_m;
    near += 1.0 - share * share;
    ++on_map;
  }
  if (asked == 0) return {};
  return {static_cast<double>(on_map) / asked, 1.0 - near / asked};
}

}  // namespace

MapFit fit_to_map(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const Pose2& map_from_laser,
                  double on_map_m, std::size_t stride) {
  return std::visit(
      [&](const auto& index) {
        return fit(points, index, map_from_laser, on_map_m, std::max<std::size_t>(stride, 1));
      },
      map);
}

}  // namespace beaconless
