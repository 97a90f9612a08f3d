// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/features/lines.hpp"

namespace beaconless {

/// Removes short runs across a corner, which a split leaves where noise hid the vertex, when the lines on
/// either side explain their beams; those run on to the bearing where they cross.
void absorb_short_runs(const OrderedPoints& points, const LineSums& sums, const LinesConfig& config,
                       std::vector<PlaceRun>& runs);

/// Moves the ends of runs that follow each other to the bearing where their lines cross, as far as the beams
/// lie on them, and then off beams that do not. `drawn` is a buffer. Cost: some beams a run.
void move_ends(const OrderedPoints& points, const LineSums& sums, const LinesConfig& config,
               std::vector<DrawnLine>& drawn, std::vector<PlaceRun>& runs);

}  // namespace beaconless
