// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/ransac_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/rigid_fit.hpp"

namespace beaconless {
namespace {

/// Draws after which two right pairs were drawn at once with the confidence asked.
double draws_needed(double right_ratio, double confidence) {
  const double miss = 1.0 - right_ratio * right_ratio;
  if (miss <= 0.0) return 1.0;
  return std::ceil(std::log(1.0 - confidence) / std::log(miss));
}

}  // namespace

void describe(Fields& fields, RansacPairsConfig& config) {
  fields("confidence", config.confidence, {0.5, 0.999999},
         "chance to have drawn two right pairs together, if the best pose met is right");
  fields("max_draws", config.max_draws, {1, 100'000'000}, "most draws of two pairs");
  fields("seed", config.seed, {0, 2'147'483'647}, "the same seed, the same match");
}

double score_pose(const FeatureSet& first, const FeatureSet& second, std::span<const FeaturePair> candidates,
                  const Pose2& second_from_first, const PairingConfig& pairing, int* near_count) {
  const Eigen::Matrix2d rotation = second_from_first.rotation();
  const Eigen::Vector2d origin = second_from_first.translation();
  const double most_m2 = pairing.same_place_m2();
  double saved = 0.0;
  int near = 0;
  for (std::size_t k = 0; k < candidates.size();) {
    const std::size_t feature = candidates[k].first;
    const Eigen::Vector2d at = rotation * first.points[feature] + origin;
    double nearest_m2 = most_m2;
    for (; k < candidates.size() && candidates[k].first == feature; ++k)
      nearest_m2 = std::min(nearest_m2, (second.points[candidates[k].second] - at).squaredNorm());
    saved += most_m2 - nearest_m2;
    near += nearest_m2 < most_m2 ? 1 : 0;
  }
  if (near_count != nullptr) *near_count = near;
  const double all = static_cast<double>(std::max<std::size_t>(first.points.size(), 1)) * most_m2;
  return 1.0 - saved / all;
}

std::optional<PairsPose> find_ransac_pose(const FeatureSet& first, const FeatureSet& second,
                                          std::span<const FeaturePair> candidates,
                                          const PairingConfig& pairing, const RansacPairsConfig& config) {
  if (candidates.size() < 2) return std::nullopt;
  const PairAgreement agreement(first, second, pairing);
  const auto count = static_cast<double>(candidates.size());
  Rng rng(static_cast<std::uint64_t>(config.seed));
  std::optional<PairsPose> best;
  double needed = config.max_draws;
  int draw = 0;
  for (; draw < config.max_draws && draw < needed; ++draw) {
    // 1. Two pairs that agree …
    const FeaturePair& a = candidates[static_cast<std::size_t>(rng.uniform() * count)];
    const FeaturePair& b = candidates[static_cast<std::size_t>(rng.uniform() * count)];
    if (!agreement.agree(a, b)) continue;

    // 2. … say where all the others are to be.
    RigidFit fit(first.points[a.first], second.points[a.second]);
    fit.add(first.points[a.first], second.points[a.second]);
    fit.add(first.points[b.first], second.points[b.second]);
    const auto pose = fit.solve();
    if (!pose) continue;
    int near = 0;
    const double score = score_pose(first, second, candidates, *pose, pairing, &near);
    if (best && score >= best->score) continue;

    // 3. The better the pose, the sooner enough has been drawn.
    best = PairsPose{.second_from_first = *pose, .score = score};
    needed = draws_needed(near / count, config.confidence);
  }
  if (!best) return best;
  best->draws = draw;
  best->certain = draw >= needed;
  return best;
}

}  // namespace beaconless
