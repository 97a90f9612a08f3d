// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/see_through.hpp"

#include <algorithm>
#include <variant>

namespace beaconless {

double see_through_share(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                         const Pose2& map_from_laser, std::size_t stride, double slack_m, std::size_t first) {
  const Eigen::Matrix2d rotation = map_from_laser.rotation();
  const std::size_t step = std::max<std::size_t>(stride, 1);
  const auto share = [&](const auto& index) {
    double through = 0.0;
    double all = 0.0;
    for (std::size_t i = first; i < points.size(); i += step, all += 1.0) {
      const double length_m = points[i].norm();
      const Eigen::Vector2d way = rotation * points[i] / std::max(length_m, 1e-9);
      through += passes_through(index, map_from_laser.translation(), way, length_m, slack_m) ? 1.0 : 0.0;
    }
    return all > 0.0 ? through / all : 0.0;
  };
  return std::visit(share, map);
}

}  // namespace beaconless
