// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/clique_pairs.hpp"

namespace beaconless {

void describe(Fields& fields, CliqueConfig& config) {
  fields("node_limit", config.node_limit, {1, 100'000'000},
         "branches of the search for the largest clique; the best met so far is taken then");
}

bool find_clique_pairs(const FeatureSet& first, const FeatureSet& second,
                       std::span<const FeaturePair> candidates, const PairingConfig& pairing,
                       const CliqueConfig& config, CliquePairsScratch& scratch,
                       std::vector<FeaturePair>& out) {
  const PairAgreement agreement(first, second, pairing);
  scratch.graph.reset(candidates.size());
  for (std::size_t a = 0; a < candidates.size(); ++a)
    for (std::size_t b = a + 1; b < candidates.size(); ++b)
      if (agreement.agree(candidates[a], candidates[b])) scratch.graph.connect(a, b);
  const bool certain = find_max_clique(scratch.graph, config.node_limit, scratch.clique, scratch.nodes);
  out.clear();
  out.reserve(scratch.nodes.size());
  for (const std::size_t node : scratch.nodes) out.push_back(candidates[node]);
  return certain;
}

}  // namespace beaconless
