// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// Features to be matched: where they are and, where known, what tells them apart. A view; owns nothing.
struct FeatureSet {
  std::span<const Eigen::Vector2d> points;
  std::span<const double> orientations_rad = {};  ///< empty, or one a point
  std::span<const int> kinds = {};  ///< empty, or one a point; features of two kinds are never the same
};

/// A feature of the first set taken for one of the second.
struct FeaturePair {
  std::size_t first = 0;
  std::size_t second = 0;
  double cost = 0.0;  ///< how unlike they are, as candidate_pairs() says; smaller is better

  friend bool operator==(const FeaturePair&, const FeaturePair&) = default;
};

/// What makes two features, or two pairs of them, agree.
struct PairingConfig {
  double sigma_m = 0.03;             ///< of a feature's position along each axis, in either set
  double turn_tolerance_rad = 0.35;  ///< by how much orientations may disagree; pi: any
  double max_descriptor_distance =
      0.4;                    ///< pairs that look less alike are not considered; kBscSame, kCghSame …
  double gate_m = 0.0;        ///< pairs further apart at the guess are not; 0: the guess is no gate
  double gate_rad = kPi;      ///< nor those whose orientations differ more from the guess
  int max_candidates = 1000;  ///< the cheapest so many are considered
  int min_pairs = 3;          ///< fewer make no match
  double max_chance = 1.0;    ///< matches that pairs_by_chance() expects more often than this are refused

  /// Squared distance that two positions of one feature exceed in 5 % of cases (chi², 2 degrees of freedom).
  double same_place_m2() const { return 5.991 * 2.0 * sigma_m * sigma_m; }
};

void describe(Fields& fields, PairingConfig& config);

/// Lists the pairs that may be the same feature, ordered by (first, second).
///
/// `distances` is empty or the matrix of descriptor_distances(). The cost of a pair is its descriptor
/// distance over the largest allowed, plus, where a gate is set or there are no descriptors, its squared
/// distance at the guess over that of the gate (over 1 m² without one). Points that are not finite have no
/// pairs.
void candidate_pairs(const FeatureSet& first, const FeatureSet& second, std::span<const float> distances,
                     const Pose2& second_from_first_guess, const PairingConfig& config,
                     std::vector<FeaturePair>& out);

/// Decides whether two pairs can both be right: the same length, and turns that agree.
///
/// With d1, d2 the distances of the features in either set: (d1² - d2²)² < 3.84 · 8 σ² (d1² + d2²), the 95 %
/// test for Gaussian positions. Where orientations are known, both pairs turn alike, and like the line from
/// one to the other does. Source: Tipaldi and Arras 2010; Bailey 2002. Differs: falkolib compares distances
/// with a fixed tolerance and ignores orientations.
class PairAgreement {
 public:
  PairAgreement(const FeatureSet& first, const FeatureSet& second, const PairingConfig& config);

  bool agree(const FeaturePair& a, const FeaturePair& b) const;

  /// Whether a pair's own orientations turn as a pose does; true where they are unknown.
  bool turns_like(const FeaturePair& pair, double turn_rad) const;

 private:
  FeatureSet first_;
  FeatureSet second_;
  double length_test_m2_;
  double sigma_m_;
  double tolerance_rad_;
  bool oriented_;
};

}  // namespace beaconless
