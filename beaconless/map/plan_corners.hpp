// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless {

/// Where two walls of a plan meet.
struct PlanCorner {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< map frame
  double orientation_rad = 0.0;  ///< of the bisector, from the corner between both walls; in [-pi, pi)
  double opening_rad = 0.0;      ///< between the two walls as they leave the corner, in (0, pi)
  double arm_m = 0.0;            ///< length of the shorter wall up to the next corner on this side of it
};

/// What counts as a corner of a plan.
struct PlanCornersConfig {
  double min_angle_deg = 10.0;  ///< between the lines of both walls
  double join_m = 0.01;         ///< ends, and an end and a wall, that are no further apart meet
};

void describe(Fields& fields, PlanCornersConfig& config);

/// The corners of a plan: where walls meet at their ends, where one ends on another, and where two cross.
///
/// Around a meeting point each gap between neighbouring walls is a corner of its own: a wall that ends on
/// another makes two, a crossing four, two ends one, which is concave from within its opening and convex from
/// without. Walls that go on straight make none, nor do free ends; pieces drawn twice count once.
/// Out: ordered by x, then y, then orientation. Cost: about linear in walls and crossings.
std::vector<PlanCorner> find_plan_corners(const FloorPlan& plan, const PlanCornersConfig& config = {});

}  // namespace beaconless
