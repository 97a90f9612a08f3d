// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless::trust {

/// What kind of place a building is.
enum class Family : int { room, racks, corridor, offices };

constexpr std::array<std::string_view, 4> kFamilies{"room", "racks", "corridor", "offices"};

/// A made-up place: what stands for ever, and what people push around.
struct Building {
  std::vector<FloorPlan::Polyline> walls;  ///< the first one is closed around all
  std::vector<FloorPlan::Polyline> furniture;
  double heading_rad = 0.0;  ///< of the drawing's x axis in the map

  FloorPlan plan() const;

  /// Whether a point lies within the first wall.
  bool is_inside(const Eigen::Vector2d& point) const;
};

/// A place of a family, 6 to 60 m large, turned any way; the same draws give the same place.
Building make_building(Family family, Rng& rng);

}  // namespace beaconless::trust
