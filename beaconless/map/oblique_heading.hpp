// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/map/floor_plan.hpp"

namespace beaconless {

/// A heading for the rows of a grid, in [0, pi/2), at which drawing the walls into its cells moves them
/// least.
///
/// A wall along the rows is off by the same part of a cell over its whole length; so is one along a diagonal,
/// and to a lesser degree one of slope 1/2, 1/3 …: their cells repeat. In between, the offsets differ from
/// cell to cell and average out over a wall, the better the longer it is. 0 for a plan without walls. Cost:
/// walls x 180. Source: Hurwitz' theorem is why such headings exist; no slope is far from all fractions.
double oblique_heading_rad(const FloorPlan& plan, double resolution_m = 0.05);

}  // namespace beaconless
