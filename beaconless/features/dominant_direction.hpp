// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/features/beam_neighbourhoods.hpp"

namespace beaconless {

/// The direction that most of what a scan sees runs along or across, in [0, pi/2), sensor frame; 0 for a scan
/// without neighbours.
///
/// Each hit votes with the direction between its outermost neighbours, times four, so that directions a
/// quarter turn apart vote for the same; the votes near the fullest of 120 bins are averaged as vectors.
/// Cost: one pass. Source: the orthogonal spectrum of falkolib's OC detector. Differs: a vote a beam instead
/// of a Hough transform over 360 x rho cells, whose public form counts only lines within 5 m; the slow twin
/// is in the tests.
double dominant_direction(const BeamNeighbourhoods& around);

}  // namespace beaconless
