// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/altered_map.hpp"

#include <cmath>

#include "beaconless/geometry/angle.hpp"

#include "bench/trust/outlines.hpp"

namespace beaconless::trust {
namespace {

Eigen::Vector2d middle_of(const FloorPlan& plan) {
  const FloorPlan::Bounds bounds = plan.bounds();
  return 0.5 * (bounds.low + bounds.high);
}

}  // namespace

Building with_moved_furniture(Building building, double share, Rng& rng) {
  for (FloorPlan::Polyline& piece : building.furniture) {
    if (rng.uniform() >= share) continue;
    const double way = rng.uniform(-kPi, kPi);
    const Eigen::Vector2d shift = rng.uniform(0.1, 1.5) * Eigen::Vector2d(std::cos(way), std::sin(way));
    piece = shifted_about_middle(std::move(piece), shift, rng.uniform(-0.8, 0.8));
  }
  return building;
}

FloorPlan with_missing_walls(const FloorPlan& plan, double share, Rng& rng) {
  constexpr double kPiece_m = 4.0;
  FloorPlan left;
  for (const Segment2& wall : plan.segments()) {
    const int pieces = static_cast<int>(std::ceil((wall.b - wall.a).norm() / kPiece_m));
    for (int i = 0; i < pieces; ++i) {
      if (rng.uniform() < share) continue;
      const auto at = [&](int end) {
        return Eigen::Vector2d(wall.a + static_cast<double>(end) / pieces * (wall.b - wall.a));
      };
      left.walls.push_back({at(i), at(i + 1)});
    }
  }
  return left;
}

FloorPlan mirrored(const Building& building) {
  FloorPlan plan = building.plan();
  const Pose2 map_from_drawing{0.0, 0.0, building.heading_rad};
  for (FloorPlan::Polyline& line : plan.walls) line = carried(std::move(line), map_from_drawing.inverse());
  const double axis = middle_of(plan).x();
  for (FloorPlan::Polyline& line : plan.walls) {
    for (Eigen::Vector2d& point : line) point.x() = 2.0 * axis - point.x();
    line = carried(std::move(line), map_from_drawing);
  }
  return plan;
}

FloorPlan laid_over(FloorPlan plan, const FloorPlan& other) {
  const Eigen::Vector2d shift = middle_of(other) - middle_of(plan);
  for (FloorPlan::Polyline& line : plan.walls)
    for (Eigen::Vector2d& point : line) point += shift;
  return plan;
}

}  // namespace beaconless::trust
