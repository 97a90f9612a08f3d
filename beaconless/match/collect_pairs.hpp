// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/match/feature_pairs.hpp"
#include "beaconless/match/fit_pairs.hpp"
#include "beaconless/match/mutual_nearest.hpp"

namespace beaconless {

/// Buffers of collect_pairs().
struct CollectScratch {
  std::vector<FeaturePair> near;
  std::vector<FeaturePair> previous;
  MutualNearestScratch nearest;
};

/// Collects all candidates that lie together at a pose, one to one, each the other's nearest; fits the pose
/// to them, and collects anew until nothing changes.
///
/// `out` holds the last ones, by first, their cost the squared distance (m²) at the pose before the last fit.
/// Gives what fit_pairs() gives. Cost: a few passes over the candidates.
MatchResult collect_pairs(const FeatureSet& first, const FeatureSet& second,
                          std::span<const FeaturePair> candidates, const Pose2& second_from_first,
                          const PairingConfig& config, CollectScratch& scratch,
                          std::vector<FeaturePair>& out);

}  // namespace beaconless
