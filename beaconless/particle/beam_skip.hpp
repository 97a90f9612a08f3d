// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/particle/laser_beams.hpp"
#include "beaconless/particle/likelihood_field.hpp"
#include "beaconless/particle/particles.hpp"

namespace beaconless {

/// Leaves out beams that end further than `beam_skip_distance` from every wall for all but a
/// `beam_skip_threshold` of the particles: people, and what is not on the map. Where that would be more than
/// a `beam_skip_error_threshold` of them, all are kept.
///
/// Only for clouds that are in one place. Cost: a look-up a beam and particle. Source: ROS's amcl
/// (`do_beamskip`).
void skip_beams(const Particles& particles, const Pose2& base_from_laser, const LikelihoodField& field,
                const AmclConfig& config, BeamEnds& ends);

}  // namespace beaconless
