// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "beaconless/match/feature_pairs.hpp"

namespace beaconless {

/// How many of all the poses that two candidates can propose would gather so many pairs by chance, if the
/// second set's features lay anywhere in their bounding box: an upper bound of the number of false alarms.
///
/// Every two candidates may propose a pose; of the n other features each has a partner there with chance
/// p = (candidates a feature) x (area of one place) / (area of the box, or of the gate around the guess), and
/// times (turns that agree) / (all turns) where orientations are known: at most C²/2 · (n over m) pᵐ with m
/// the pairs beyond the first two. Far below 1: not by chance. Walls put features in lines, so that real ones
/// meet by chance more often than this says, and two proposals that disagree are counted, so that it says too
/// much; the two were seen to about cancel. Source: Moisan and Stival, "A probabilistic criterion to detect
/// rigid point matches between two images", IJCV 2004. Differs: a product bounds the tail of the binomial.
double pairs_by_chance(const FeatureSet& first, const FeatureSet& second, std::size_t candidate_count,
                       std::size_t pair_count, const PairingConfig& config);

}  // namespace beaconless
