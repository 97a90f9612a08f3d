// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/occupancy_grid.hpp"
#include "beaconless/map/ray_caster.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// From where and how a map is looked at.
struct MapViewsConfig {
  double step_m = 0.4;       ///< between neighbouring places, about; less where the map is small
  double clearance_m = 0.3;  ///< no wall is nearer to them
  double range_m = 30.0;     ///< how far is looked
  double beam_deg = 0.25;    ///< between two beams; that of the scanner
  int most = 3000;           ///< of larger maps the step is made larger
};

void describe(Fields& fields, MapViewsConfig& config);

/// Places all over a map's free space, with headings all around.
///
/// A place is within the walls' bounds, has walls around it in nearly all directions and, where a grid is
/// given, lies in a free cell of it; if there is no such place, one with walls around it in some directions
/// will do. They lie on a lattice, moved and turned at random, so that they line up with no wall; the same
/// map gives the same places. None: no walls, or no room between them.
std::vector<Pose2> choose_map_views(const RayCaster& walls, const OccupancyGrid* grid,
                                    const MapViewsConfig& config = {});

/// A sweep of a whole turn without noise, as a robot would see a map from a place.
Scan look_at_map(const RayCaster& walls, const Pose2& map_from_laser, const MapViewsConfig& config = {});

}  // namespace beaconless
