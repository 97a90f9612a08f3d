// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/match/feature_map.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/match/robust_loss.hpp"

namespace beaconless {

/// Re-weighted ICP on point features: what it may pair and when it stops.
struct FeatureIcpConfig {
  LossKind loss = LossKind::huber;
  double loss_k_sigma = 0.0;         ///< scale of the loss in sigmas; 0: 95 % efficiency in the plane
  double max_pair_distance_m = 0.5;  ///< features further apart than this are never the same
  double max_turn_deg = 30.0;        ///< nor those whose orientations differ by more …
  double max_opening_deg = 30.0;     ///< … or whose walls meet at other angles; where both are known
  double gate_sigma = 4.0;           ///< once near, pairs further apart than this many sigmas are dropped
  double least_sigma_m = 0.002;      ///< no feature is placed better than this, whatever it says
  int min_pairs = 2;                 ///< a single feature tells no heading
  int max_iterations = 30;
  double converged_m = 1e-5;           ///< stop when a step moves the laser less than this …
  double converged_rad = 1e-6;         ///< … and turns it less than this
  double unobservable_sigma_m = 0.25;  ///< a direction less certain than this is held at the guess
};

void describe(Fields& fields, FeatureIcpConfig& config);

/// A feature of the scan and the one of the map that it was taken for.
struct FeatureIcpPair {
  std::size_t seen = 0;
  std::size_t mapped = 0;
  Eigen::Vector2d arm = Eigen::Vector2d::Zero();              ///< from the laser to it, map axes
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();         ///< from the map's to the scan's
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity();  ///< inverse covariance of the residual
  double sigmas = 0.0;                                        ///< length of the residual, whitened
  double weight = 0.0;
};

/// Buffers that live on from call to call; `pairs` are those of the last match.
struct FeatureIcpScratch {
  std::vector<FeatureIcpPair> pairs;
  std::vector<FeatureIcpPair> candidates;
  std::vector<double> nearest_of_seen;
  std::vector<double> nearest_of_mapped;
  std::vector<double> sorted;
};

/// Fits features of a scan onto those of a map, from a guess nearby.
///
/// In: features in the laser frame. Out: map_from_laser with covariance (Σ w Jᵀ S⁻¹ J)⁻¹, grown where the
/// residuals are larger than the covariances of the features say; `on_map_ratio` and `misfit` are not told
/// (see fit_to_map). Status: too_few_pairs leaves the guess. Cost: features x neighbours in the map x
/// iterations, a few microseconds for a dozen corners; nothing allocated once the buffers have grown.
///
/// Source: dissertation 3.2 (first approach) and Algorithm 6; 2.3.1. Differs: (1) Algorithm 6 never resets
/// d_min and stores no partner, has C of rank one and T reversed: corrected in RigidFit; (2) pairs are one to
/// one, nearest of both sides, and only of corners that open alike and the same way: a room's corner is never
/// taken for a pillar's; (3) residuals are whitened by the covariances of both features before they are
/// weighted, so that the loss' constants mean what they say and a corner of long walls counts more; the
/// closed form starts, Gauss-Newton steps on the whitened residuals end it; (4) convergence, pair count and
/// observability are checked.
MatchResult match_feature_icp(std::span<const PointFeature> seen, const FeatureMap& map, const Pose2& guess,
                              const FeatureIcpConfig& config, FeatureIcpScratch& scratch);

}  // namespace beaconless
