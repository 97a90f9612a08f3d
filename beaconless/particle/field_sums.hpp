// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/particle/laser_beams.hpp"
#include "beaconless/particle/likelihood_field.hpp"
#include "beaconless/particle/particles.hpp"

namespace beaconless {

/// Whether this processor has loops of eight lanes (AVX2).
bool has_wide_lanes();

/// Adds up, for every particle, the bytes of the field where the beams end.
///
/// Out: a sum a particle. Cost: one sine and cosine a particle, half a nanosecond or so a beam of each;
/// nothing allocated once `sums` has grown. `wide` takes eight lanes, which must be there; both give the same
/// but for an end that rounding puts into the next cell.
void sum_field(const Particles& particles, const Pose2& base_from_laser, const BeamEnds& ends,
               const LikelihoodField& field, std::vector<std::int32_t>& sums, bool wide = has_wide_lanes());

}  // namespace beaconless
