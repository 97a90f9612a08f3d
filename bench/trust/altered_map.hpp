// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/rng.hpp"

#include "bench/trust/building.hpp"

namespace beaconless::trust {

/// As it was drawn before a share of the furniture was pushed elsewhere and turned.
Building with_moved_furniture(Building building, double share, Rng& rng);

/// The walls, but for a share of them, in pieces of at most four metres.
FloorPlan with_missing_walls(const FloorPlan& plan, double share, Rng& rng);

/// Both ends of the drawing exchanged: what is symmetric stays as it is.
FloorPlan mirrored(const Building& building);

/// Carried to where the middle of its bounds is that of another plan's.
FloorPlan laid_over(FloorPlan plan, const FloorPlan& other);

}  // namespace beaconless::trust
