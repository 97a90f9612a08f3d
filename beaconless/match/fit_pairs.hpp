// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "beaconless/match/feature_pairs.hpp"
#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// The pose that carries the first set's features of these pairs onto the second's: second_from_first.
///
/// Weighted closed form, re-weighted a few times by 1 / (1 + (r / s)²) with s the usual residual, so that a
/// misplaced feature pulls little. Covariance: σ̂² (Σ w Jᵀ J)⁻¹ with σ̂ from the residuals, at least what
/// sigma_m makes of so many pairs. Status: too_few_pairs (pose: the guess) with fewer than min_pairs, or when
/// all lie in one place. Source: RigidFit; Cauchy's weights, dissertation 2.3.1.
MatchResult fit_pairs(const FeatureSet& first, const FeatureSet& second, std::span<const FeaturePair> pairs,
                      const Pose2& guess, const PairingConfig& config);

}  // namespace beaconless
