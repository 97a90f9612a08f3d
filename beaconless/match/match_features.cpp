// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/match_features.hpp"

#include <optional>

#include "beaconless/match/fit_pairs.hpp"
#include "beaconless/match/pairs_by_chance.hpp"

namespace beaconless {
namespace {

/// The pose of the largest clique; nothing where the clique is too small to have one.
std::optional<PairsPose> clique_pose(const FeatureSet& first, const FeatureSet& second,
                                     const FeatureMatchConfig& config, FeatureMatchScratch& scratch) {
  const bool certain = find_clique_pairs(first, second, scratch.candidates, config.pairing, config.clique,
                                         scratch.clique, scratch.seeds);
  const MatchResult fit = fit_pairs(first, second, scratch.seeds, {}, config.pairing);
  if (!fit.usable()) return std::nullopt;
  return PairsPose{.second_from_first = fit.map_from_laser, .certain = certain};
}

MatchResult no_match(const Pose2& guess, std::size_t pair_count) {
  MatchResult none;
  none.map_from_laser = guess;
  none.status = MatchStatus::too_few_pairs;
  none.pair_count = static_cast<int>(pair_count);
  return none;
}

std::optional<PairsPose> find_pose(const FeatureSet& first, const FeatureSet& second,
                                   const FeatureMatchConfig& config, FeatureMatchScratch& scratch) {
  switch (config.method) {
    case FeatureMatchMethod::ransac:
      return find_ransac_pose(first, second, scratch.candidates, config.pairing, config.ransac);
    case FeatureMatchMethod::hough:
      return find_hough_pose(first, second, scratch.candidates, config.pairing, config.hough, scratch.hough);
    case FeatureMatchMethod::clique:
    case FeatureMatchMethod::mutual_nearest:
      break;
  }
  return clique_pose(first, second, config, scratch);
}

}  // namespace

void describe(Fields& fields, FeatureMatchConfig& config) {
  fields("method", config.method, {"mutual-nearest", "ransac", "clique", "hough"},
         "how right pairs are told from wrong ones");
  fields.section("pairing", config.pairing);
  fields.section("ransac", config.ransac);
  fields.section("clique", config.clique);
  fields.section("hough", config.hough);
}

FeatureMatch match_features(const FeatureSet& first, const FeatureSet& second,
                            const FeatureMatchConfig& config, std::span<const float> descriptor_distances,
                            const Pose2& guess) {
  FeatureMatchScratch scratch;
  FeatureMatch out;
  match_features(first, second, config, descriptor_distances, guess, scratch, out);
  return out;
}

void match_features(const FeatureSet& first, const FeatureSet& second, const FeatureMatchConfig& config,
                    std::span<const float> descriptor_distances, const Pose2& guess,
                    FeatureMatchScratch& scratch, FeatureMatch& out) {
  // 1. What may be the same at all.
  candidate_pairs(first, second, descriptor_distances, guess, config.pairing, scratch.candidates);
  out.pairs.clear();
  out.chance = 1.0;
  out.result = no_match(guess, 0);

  // 2. A pose, 3. all pairs that it makes agree.
  if (config.method == FeatureMatchMethod::mutual_nearest) {
    find_mutual_nearest(scratch.candidates, scratch.mutual_nearest, out.pairs);
    out.result = fit_pairs(first, second, out.pairs, guess, config.pairing);
  } else if (const auto pose = find_pose(first, second, config, scratch)) {
    out.result = collect_pairs(first, second, scratch.candidates, pose->second_from_first, config.pairing,
                               scratch.collect, out.pairs);
    if (out.result.usable() && !pose->certain) out.result.status = MatchStatus::max_iterations;
    out.chance = pairs_by_chance(first, second, scratch.candidates.size(), out.pairs.size(), config.pairing);
    if (out.chance > config.pairing.max_chance) out.result = no_match(guess, out.pairs.size());
  }

  // 4. What it explains.
  if (!out.result.usable()) {
    out.result.map_from_laser = guess;
    return;
  }
  out.result.on_map_ratio = static_cast<double>(out.pairs.size()) / static_cast<double>(first.points.size());
  out.result.misfit =
      score_pose(first, second, scratch.candidates, out.result.map_from_laser, config.pairing);
}

}  // namespace beaconless
