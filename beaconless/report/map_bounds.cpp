// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/map_bounds.hpp"

#include <algorithm>

namespace beaconless::report {
namespace {

constexpr double kFarthest_m = 1e7;
constexpr double kSmallest_m = 1.0;
constexpr double kMargin_ratio = 0.04;

void extend(Eigen::AlignedBox2d& box, const Eigen::Vector2d& point) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest_m) box.extend(point);
}

Eigen::AlignedBox2d bounds_of(const FloorPlan& plan) {
  Eigen::AlignedBox2d box;
  for (const auto& wall : plan.walls)
    for (const Eigen::Vector2d& corner : wall) extend(box, corner);
  return box;
}

/// Around the cells that `counts`; only the ends of each row can lie on the edge of that.
template <class Counts>
Eigen::AlignedBox2d bounds_of_cells(const OccupancyGrid& grid, Counts counts) {
  Eigen::AlignedBox2d box;
  for (int y = 0; y < grid.height_cells; ++y) {
    int first = 0;
    int last = grid.width_cells - 1;
    while (first <= last && !counts(Cell{first, y})) ++first;
    while (first <= last && !counts(Cell{last, y})) --last;
    if (first > last) continue;
    extend(box, grid.center({first, y}));
    extend(box, grid.center({last, y}));
  }
  return box;
}

Eigen::AlignedBox2d bounds_of(const OccupancyGrid& grid) {
  if (grid.width_cells <= 0 || grid.height_cells <= 0 ||
      grid.occupancy_percent.size() !=
          static_cast<std::size_t>(grid.width_cells) * static_cast<std::size_t>(grid.height_cells))
    return {};
  const Eigen::AlignedBox2d box = bounds_of_cells(grid, [&](Cell cell) { return grid.is_occupied(cell); });
  return box.isEmpty() ? bounds_of_cells(grid, [&](Cell cell) { return grid.at(cell) >= 0; }) : box;
}

}  // namespace

Eigen::AlignedBox2d bounds_of_run(const Map& map, std::span<const PoseEstimate> estimates,
                                  const Trajectory& reference) {
  Eigen::AlignedBox2d box = std::visit([](const auto& m) { return bounds_of(m); }, map);
  Eigen::AlignedBox2d near(Eigen::Vector2d::Constant(-kFarthest_m), Eigen::Vector2d::Constant(kFarthest_m));
  if (!box.isEmpty()) {
    const Eigen::Vector2d slack = Eigen::Vector2d::Constant(std::max(0.5 * box.sizes().maxCoeff(), 2.0));
    near = Eigen::AlignedBox2d(box.min() - slack, box.max() + slack);
  }
  const auto extend_near = [&](const Pose2& pose) {
    if (pose.is_finite() && near.contains(pose.translation())) extend(box, pose.translation());
  };
  for (const PoseEstimate& estimate : estimates)
    if (estimate.status != Status::not_started) extend_near(estimate.map_from_base);
  for (const StampedPose& stamped : reference) extend_near(stamped.pose);
  if (box.isEmpty()) box.extend(Eigen::Vector2d::Zero());

  const double margin = std::max(kMargin_ratio * box.sizes().maxCoeff(), 0.1);
  const Eigen::Vector2d size = (box.sizes() + Eigen::Vector2d::Constant(2.0 * margin)).cwiseMax(kSmallest_m);
  return {box.center() - 0.5 * size, box.center() + 0.5 * size};
}

}  // namespace beaconless::report
