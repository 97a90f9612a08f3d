// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/match/feature_pairs.hpp"
#include "beaconless/match/max_clique.hpp"

namespace beaconless {

struct CliqueConfig {
  int node_limit = 20'000;  ///< branches of the search; more make a match max_iterations
};

void describe(Fields& fields, CliqueConfig& config);

/// Buffers of find_clique_pairs().
struct CliquePairsScratch {
  BitGraph graph;
  MaxCliqueScratch clique;
  std::vector<std::size_t> nodes;
};

/// The largest set of candidates of which any two agree (see PairAgreement), in the order of the candidates.
///
/// Returns whether none is larger for sure. Cost: candidates² / 2 agreement tests, then find_max_clique.
/// Source: Bailey, "Mobile robot localisation and mapping in extensive outdoor environments", 2002, chapter 3
/// (combined constraint data association). Differs: falkolib's match returns nothing where it promises a
/// number, gates on the sum of distances, does not look at orientations, and has no limit to its search.
bool find_clique_pairs(const FeatureSet& first, const FeatureSet& second,
                       std::span<const FeaturePair> candidates, const PairingConfig& pairing,
                       const CliqueConfig& config, CliquePairsScratch& scratch,
                       std::vector<FeaturePair>& out);

}  // namespace beaconless
