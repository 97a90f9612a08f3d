// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/mutual_nearest.hpp"

#include <algorithm>
#include <limits>

namespace beaconless {
namespace {

void note(MutualNearestScratch::Least& least, double cost) {
  if (cost < least.cost)
    least = {cost, 1};
  else if (cost == least.cost)
    ++least.times;
}

}  // namespace

void find_mutual_nearest(std::span<const FeaturePair> candidates, MutualNearestScratch& scratch,
                         std::vector<FeaturePair>& out) {
  // 1. The least cost of every feature.
  std::size_t first_count = 0;
  std::size_t second_count = 0;
  for (const FeaturePair& pair : candidates) {
    first_count = std::max(first_count, pair.first + 1);
    second_count = std::max(second_count, pair.second + 1);
  }
  constexpr MutualNearestScratch::Least kNone{std::numeric_limits<double>::infinity(), 0};
  scratch.of_first.assign(first_count, kNone);
  scratch.of_second.assign(second_count, kNone);
  for (const FeaturePair& pair : candidates) {
    note(scratch.of_first[pair.first], pair.cost);
    note(scratch.of_second[pair.second], pair.cost);
  }

  // 2. Pairs that are the only cheapest for both.
  out.clear();
  out.reserve(candidates.size());
  for (const FeaturePair& pair : candidates) {
    const auto& of_first = scratch.of_first[pair.first];
    const auto& of_second = scratch.of_second[pair.second];
    if (pair.cost == of_first.cost && of_first.times == 1 && pair.cost == of_second.cost &&
        of_second.times == 1)
      out.push_back(pair);
  }
}

}  // namespace beaconless
