// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless::trust {

/// The closed outline of a rectangle along the axes.
inline FloorPlan::Polyline rectangle_at(const Eigen::Vector2d& low, const Eigen::Vector2d& size) {
  const Eigen::Vector2d high = low + size;
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
}

/// A polyline carried by a rigid motion.
inline FloorPlan::Polyline carried(FloorPlan::Polyline line, const Pose2& a_from_b) {
  for (Eigen::Vector2d& point : line) point = a_from_b * point;
  return line;
}

/// The same about its own middle: of its bounds.
inline FloorPlan::Polyline shifted_about_middle(FloorPlan::Polyline line, const Eigen::Vector2d& shift,
                                                double turn_rad) {
  Eigen::Vector2d low = line.front();
  Eigen::Vector2d high = line.front();
  for (const Eigen::Vector2d& point : line) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2d middle = 0.5 * (low + high);
  for (Eigen::Vector2d& point : line) point -= middle;
  return carried(std::move(line), {middle.x() + shift.x(), middle.y() + shift.y(), turn_rad});
}

}  // namespace beaconless::trust
