// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/match/robust_loss.hpp"

namespace beaconless {

/// How a step of ICP is found.
enum class IcpSolver : int {
  alignment,  ///< the closed form alone, as in the dissertation
  mixed,      ///< the closed form far away, Gauss-Newton on the distances to the walls near by
};

/// Re-weighted ICP: what it may use and when it stops.
struct IcpConfig {
  double sigma_m = 0.01;     ///< range noise of the laser; no scale is ever smaller
  double map_sigma_m = 0.0;  ///< by how much the map's walls are off; 0: what the map's kind suggests
  LossKind loss = LossKind::huber;
  double loss_k_sigma = 0.0;  ///< scale of the loss in sigmas; 0: 95 % efficiency
  IcpSolver solver = IcpSolver::mixed;
  double max_pair_distance_m = 0.6;  ///< pairs further apart are not made
  double gate_sigma = 6.0;  ///< once near, pairs further apart than this many robust sigmas are dropped
  double on_map_m = 0.10;   ///< a point this near to a wall counts as explained by the map
  int max_iterations = 60;
  double converged_m = 1e-5;           ///< stop when a step moves the laser less than this …
  double converged_rad = 1e-6;         ///< … and turns it less than this
  double unobservable_sigma_m = 0.25;  ///< a direction less certain than this is held at the guess
  int min_pairs = 12;
};

void describe(Fields& fields, IcpConfig& config);

/// Buffers that live on from call to call, so that a match allocates nothing.
struct IcpScratch {
  struct Pair {
    Eigen::Vector2d arm;       ///< from the laser to the scan's point, map axes
    Eigen::Vector2d residual;  ///< from the surface to the point
    Eigen::Vector2d normal;    ///< unit, along the residual where there is one
    double distance_m;
  };
  std::vector<Pair> pairs;
  std::vector<double> sorted;
};

/// Fits the points of a scan onto the surfaces of a map, from a guess nearby.
///
/// In: points in the laser frame (m). Out: map_from_laser with covariance. Cost: points x iterations x one
/// nearest look-up; see bench/match_bench. Status: too_few_pairs leaves the guess; never throws, never NaN.
///
/// Source: dissertation 2.3.1, 3.2 (second approach) and Algorithm 6: nearest points, robust weights,
/// closed-form weighted alignment, repeated. Differs: (1) nearest points are exact projections onto the
/// walls, not samples between corners, which would bias by their spacing; (2) residuals are divided by their
/// robust scale before weighting; (3) Algorithm 6 never resets d_min, stores no partner, has C of rank one
/// and T reversed: corrected in RigidFit; (4) a partner slides along its wall, so the closed form alone
/// converges only linearly (factor 1/2 in a square room, far worse in a corridor): the mixed solver takes
/// Gauss-Newton steps on the distances to the walls once near, with the same fixed point; (5) convergence,
/// pair count and observability are checked, and the covariance is the sandwich H⁻¹ (Σ w² r² J Jᵀ) H⁻¹ of the
/// residuals met, plus the map's own error.
MatchResult match_icp(std::span<const Eigen::Vector2d> points, const WallIndex& map, const Pose2& guess,
                      const IcpConfig& config, IcpScratch& scratch);
MatchResult match_icp(std::span<const Eigen::Vector2d> points, const CellIndex& map, const Pose2& guess,
                      const IcpConfig& config, IcpScratch& scratch);
MatchResult match_icp(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const Pose2& guess,
                      const IcpConfig& config, IcpScratch& scratch);

}  // namespace beaconless
