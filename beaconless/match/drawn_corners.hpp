// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/map/plan_corners.hpp"
#include "beaconless/match/repeated_finds.hpp"
#include "beaconless/match/views_in_sight.hpp"

namespace beaconless {

/// Puts the corners that are drawn in a plan in the place of those that views of it showed.
///
/// A drawn corner that some view found is kept as drawn, and what was found of it is left out. One that views
/// see but none finds is left out: it is too small, or half hidden. One that no view sees may lie where there
/// was no room for a view, and is kept, unless it is behind one that was found: the other side of a wall with
/// thickness. Finds without a drawn corner stay: where a cupboard stands a hand's breadth before a wall, its
/// side and the wall cross at a place that no scan can tell from a corner.
///
/// In: `found`, of all finds; Out: ordered by x, then y, then orientation.
std::vector<RepeatedFind> prefer_drawn_corners(std::span<const PlanCorner> drawn,
                                               std::span<const MapFind> finds,
                                               std::span<const RepeatedFind> found, const ViewsInSight& views,
                                               double view_range_m, const RepeatedFindsConfig& config);

}  // namespace beaconless
