// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless::sim {

/// How well somebody measures a room with a tape.
struct TapeConfig {
  double offset_sigma_m = 0.008;  ///< of each wall, along its normal
  double turn_sigma_deg = 0.2;    ///< of each wall, about its middle
  double body_m = 0.5;            ///< closed outlines no larger than this are measured as one thing
  double flat_deg = 20.0;         ///< neighbours that turn by less share their corner, see below
  int seed = 1;
};

void describe(Fields& fields, TapeConfig& config);

/// A floor plan as somebody with a tape would have drawn it: every wall a little off, each for itself.
///
/// Out: the same polylines; corners lie where the moved walls cross, so that outlines stay closed and corners
/// stay corners. An end of an open polyline that touches a wall still touches it; any other moves along its
/// own wall as far as walls move across. Where neighbours are nearly in line their crossing could be
/// anywhere: there the corner is in the middle of where each of them would have it. Small closed outlines (a
/// bin, a leg of a table) are shifted and turned as a whole. Pieces of no length are left out, polylines that
/// are not finite or have fewer than two points stay as they are. The same plan and config give the same
/// bits, and a polyline's error does not depend on those after it. Cost: O(ends x walls).
///
/// Source: dissertation 4.2, "manually measured with measuring tape and afterwards digitally constructed".
/// Differs: it does not say how well; 8 mm and 0.2 deg are this project's.
FloorPlan tape_measured(const FloorPlan& plan, const TapeConfig& config = {});

}  // namespace beaconless::sim
