// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/match/clique_pairs.hpp"
#include "beaconless/match/collect_pairs.hpp"
#include "beaconless/match/feature_pairs.hpp"
#include "beaconless/match/hough_alignment.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/match/mutual_nearest.hpp"
#include "beaconless/match/ransac_pairs.hpp"

namespace beaconless {

/// How the right pairs are told from the wrong ones.
enum class FeatureMatchMethod : int {
  mutual_nearest,  ///< each other's nearest at a good guess, or the most alike
  ransac,          ///< the pose of two pairs that most others agree with
  clique,          ///< the largest set of pairs that all agree
  hough,           ///< the heading and then the position with most votes
};

struct FeatureMatchConfig {
  FeatureMatchMethod method = FeatureMatchMethod::clique;
  PairingConfig pairing;
  RansacPairsConfig ransac;
  CliqueConfig clique;
  HoughConfig hough;
};

void describe(Fields& fields, FeatureMatchConfig& config);

/// A pose, and the pairs it rests on: one to one, ordered by first.
///
/// `result.map_from_laser` is second_from_first: the pose of the laser in the map when features of a scan are
/// matched with those of a map, or in the frame of the other scan.
struct FeatureMatch {
  MatchResult result;
  std::vector<FeaturePair> pairs;
  double chance =
      1.0;  ///< pairs_by_chance() of them; mutual_nearest, which has a guess to stand on, leaves 1
};

/// Buffers that live on from call to call.
struct FeatureMatchScratch {
  std::vector<FeaturePair> candidates;
  std::vector<FeaturePair> seeds;
  MutualNearestScratch mutual_nearest;
  CliquePairsScratch clique;
  HoughScratch hough;
  CollectScratch collect;
};

/// Finds which features of two sets are the same, and the pose that follows.
///
/// In: two sets; `descriptor_distances` empty or as the function of that name gives them; a guess, which only
/// mutual_nearest needs and which otherwise matters where `gate_m` is set. Out: pairs and second_from_first
/// with its covariance. Status: converged; max_iterations where the search was cut short and something better
/// may exist; too_few_pairs (pose: the guess) where fewer than min_pairs agree, or no more than chance makes
/// agree (max_chance). `on_map_ratio` is the share
/// of the first set that found a partner, `misfit` the truncated score of the pose. Two places that look
/// alike are not told apart: one of them comes out. The second form allocates nothing once its buffers have
/// grown.
///
/// Source: ransac, Tipaldi and Arras 2010; clique, Bailey 2002; hough, Kallasi et al. 2016. Differs: what
/// each part says of itself; every method but mutual_nearest ends with the same collection of all pairs that
/// agree, one to one, and a robust fit.
FeatureMatch match_features(const FeatureSet& first, const FeatureSet& second,
                            const FeatureMatchConfig& config = {},
                            std::span<const float> descriptor_distances = {}, const Pose2& guess = {});
void match_features(const FeatureSet& first, const FeatureSet& second, const FeatureMatchConfig& config,
                    std::span<const float> descriptor_distances, const Pose2& guess,
                    FeatureMatchScratch& scratch, FeatureMatch& out);

}  // namespace beaconless
