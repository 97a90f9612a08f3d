// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/rng.hpp"
#include "beaconless/sim/path.hpp"

#include "bench/trust/building.hpp"

namespace beaconless::trust {

/// A drive through the free space of a building that takes about so long, from a place anywhere in it.
sim::Path make_way(const Building& building, double duration_s, Rng& rng);

}  // namespace beaconless::trust
