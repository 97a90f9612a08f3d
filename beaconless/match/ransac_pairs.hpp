// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "beaconless/match/feature_pairs.hpp"

namespace beaconless {

struct RansacPairsConfig {
  double confidence = 0.99;  ///< chance to have drawn two right pairs, if the best pose met is right
  int max_draws = 20'000;    ///< of two pairs; most of them fail the cheap test of agreement
  int seed = 1;              ///< the same seed, the same match
};

void describe(Fields& fields, RansacPairsConfig& config);

/// A pose that candidates voted for.
struct PairsPose {
  Pose2 second_from_first;
  double score = 0.0;  ///< mean over the first set of the nearest candidate's squared distance, truncated at
                       ///< same_place_m2() and in its units: 0 … 1, smaller is better
  int draws = 0;
  bool certain = false;  ///< whether the confidence was reached
};

/// Scores a pose by how near each first feature's nearest candidate partner comes (see PairsPose::score).
/// `candidates` are ordered by first.
double score_pose(const FeatureSet& first, const FeatureSet& second, std::span<const FeaturePair> candidates,
                  const Pose2& second_from_first, const PairingConfig& pairing, int* near_count = nullptr);

/// Draws two candidates again and again, lets those that agree propose a pose, and keeps the best; nothing
/// where no two agree.
///
/// Cost: draws x a test of agreement, and a pass over the candidates for each that passes. Source: Tipaldi
/// and Arras 2010; Fischler and Bolles 1981; truncated score as MSAC, Torr and Zisserman 2000. Differs:
/// flirtlib draws 18 times whatever the data; here until a draw of two right pairs is as likely as asked,
/// (right pairs / candidates)² a draw, failed draws counted because that chance counts them. Its generator is
/// seeded alike in every call by accident; here by the config. Pairs come out one to one (collect_pairs).
std::optional<PairsPose> find_ransac_pose(const FeatureSet& first, const FeatureSet& second,
                                          std::span<const FeaturePair> candidates,
                                          const PairingConfig& pairing, const RansacPairsConfig& config);

}  // namespace beaconless
