// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/match/feature_pairs.hpp"

namespace beaconless {

/// Buffers of find_mutual_nearest().
struct MutualNearestScratch {
  struct Least {
    double cost;
    std::size_t times;  ///< how many pairs cost that
  };
  std::vector<Least> of_first;
  std::vector<Least> of_second;
};

/// The pairs that are each other's cheapest, in the order of the candidates.
///
/// One to one, and the same pairs in whatever order features come: a feature with two partners of the same
/// cost has none. Cost: twice the candidates. Source: mutual nearest neighbours, long known. Differs:
/// falkolib takes the first free neighbour in index order, with thresholds that have no default.
void find_mutual_nearest(std::span<const FeaturePair> candidates, MutualNearestScratch& scratch,
                         std::vector<FeaturePair>& out);

}  // namespace beaconless
