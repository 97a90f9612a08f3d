// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/collect_pairs.hpp"

#include <algorithm>

namespace beaconless {

MatchResult collect_pairs(const FeatureSet& first, const FeatureSet& second,
                          std::span<const FeaturePair> candidates, const Pose2& second_from_first,
                          const PairingConfig& config, CollectScratch& scratch,
                          std::vector<FeaturePair>& out) {
  constexpr int kRounds = 10;
  const auto same = [](const FeaturePair& a, const FeaturePair& b) {
    return a.first == b.first && a.second == b.second;
  };
  const PairAgreement agreement(first, second, config);
  MatchResult result;
  result.map_from_laser = second_from_first;
  out.clear();
  out.reserve(candidates.size());
  scratch.near.reserve(candidates.size());
  scratch.previous.reserve(candidates.size());
  for (int round = 1; round <= kRounds; ++round) {
    // 1. What lies together at this pose.
    const Pose2 pose = result.map_from_laser;
    const Eigen::Matrix2d rotation = pose.rotation();
    const Eigen::Vector2d origin = pose.translation();
    scratch.near.clear();
    for (const FeaturePair& pair : candidates) {
      const double apart_m2 =
          (rotation * first.points[pair.first] + origin - second.points[pair.second]).squaredNorm();
      if (apart_m2 <= config.same_place_m2() && agreement.turns_like(pair, pose.theta_rad))
        scratch.near.push_back({pair.first, pair.second, apart_m2});
    }

    // 2. Those that are each other's nearest.
    scratch.previous.swap(out);
    find_mutual_nearest(scratch.near, scratch.nearest, out);

    // 3. Fit; the same pairs again are the last ones.
    if (round > 1 &&
        std::equal(out.begin(), out.end(), scratch.previous.begin(), scratch.previous.end(), same))
      break;
    result = fit_pairs(first, second, out, pose, config);
    result.iterations = round;
    if (!result.usable()) break;
  }
  return result;
}

}  // namespace beaconless
