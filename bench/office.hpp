// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "beaconless/map/floor_plan.hpp"

namespace beaconless::bench {

/// A floor of offices: corridors 2.4 m wide along x, rooms 5 m deep on both sides of each, from 2.6 m to 7 m
/// wide with a door, a few desks and cupboards; no two alike. It begins at the origin.
FloorPlan office(const Eigen::Vector2d& size_m, std::uint64_t seed);

}  // namespace beaconless::bench
