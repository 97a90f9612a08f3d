// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/drives.hpp"

namespace beaconless::bench {

/// A hall of 60 m x 40 m with six double racks: 988 walls, most of them the 10 cm of an upright.
FloorPlan warehouse();

/// So many halls along each side of a site, all like warehouse(), on a lattice of 70 m x 50 m. The hall in
/// the middle stands where the one of warehouse() does.
FloorPlan warehouses(int halls_a_side);

/// Where one of them is, from the one in the middle; columns and rows from 0.
Eigen::Vector2d hall_at(int halls_a_side, int column, int row);

/// 1081 beams at 40 Hz with 10 mm of noise, around the racks and through the aisles of warehouse(): 71 m, all
/// beams of a sweep at once.
Drive warehouse_drive();

/// The same laser on an ellipse in a room of 12 m x 8 m with 22 pieces of furniture: 92 walls.
Drive furnished_room_drive();

}  // namespace beaconless::bench
