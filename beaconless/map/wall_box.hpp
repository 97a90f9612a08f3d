// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "beaconless/map/map.hpp"

namespace beaconless {

/// The box around a map's walls, or the middles of its occupied cells; empty where there are none.
///
/// In metres, along the axes of the map frame. Cost: one look at every wall or cell.
Eigen::AlignedBox2d wall_box(const Map& map);

}  // namespace beaconless
