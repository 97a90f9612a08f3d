// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "bench/trust/building.hpp"
#include "bench/trust/disguise.hpp"
#include "bench/trust/trial.hpp"

namespace beaconless::trust {

/// What is wrong between the map and what the scanner sees.
enum class Kind : int { clean, people, moved, missing, glass, wrong_map, mirrored, combined };

constexpr std::array<std::string_view, 8> kKinds{"clean", "people",    "moved",    "missing",
                                                 "glass", "wrong_map", "mirrored", "combined"};

/// Of ten seeds one after the other two have people and two several faults; families change every ten.
Kind kind_of(std::uint64_t seed);
Family family_of(std::uint64_t seed);

/// About 200 scans of a robot that drives through a made-up building; everything follows from the seed.
Trial simulated_trial(std::uint64_t seed);

/// Two drives in one building with the right map and nobody in it, to be spliced into a kidnapping. Both
/// start at the truth and have the same map.
std::array<Trial, 2> simulated_parts(std::uint64_t seed);

}  // namespace beaconless::trust
