// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/match/wall_pieces.hpp"

namespace beaconless {

/// What is known of a fit of walls besides its sums.
struct SeparatedFit {
  double variance_factor = 1.0;  ///< of the pose, over the inverse of Σ w J Jᵀ / variance
  double curvature = 1.0;        ///< mean of that of the beams' losses, over the mean weight
  double map_sigma_m = 0.0;      ///< of what all walls may be off by alike
  double arm_m = 1.0;            ///< root mean square distance of the beams
  Eigen::Vector3d last_step = Eigen::Vector3d::Zero();  ///< from where the sums were made to the fit
};

/// Where a pose goes when some of its beams are left out, and how uncertain it is there.
struct WallRest {
  bool is_determined = false;
  double dx_m = 0.0;  ///< along the axes of the frame of the beams
  double dy_m = 0.0;
  double dtheta_rad = 0.0;
  double variance_m2 = 0.0;  ///< along the worst direction
  double variance_rad2 = 0.0;

  double way_m2() const { return dx_m * dx_m + dy_m * dy_m; }
};

/// The larger eigenvalue of a symmetric 2x2 matrix.
double largest_of(double xx, double xy, double yy);

/// The gradient's change by what walls are off by: Σ v vᵀ, each v the pull of a line off by one deviation.
struct WallPulls {
  std::array<double, 6> squares{};  ///< xx, xy, yy, xt, yt, tt

  void add(const WallPiece& line, double variance_m2);
};

/// The rest of the beams, to first order: the step d = -(H - H_g)⁻¹ (∇ - ∇_g) / c, with the variance of
/// noise, of walls off by themselves, and of a map off as a whole.
///
/// In: the sums of all beams and of those left out, at the fit. Cost: some 150 operations. Source: the
/// down-dated normal equations.
WallRest rest_without(const PartialSums& all, const PartialSums& left_out, const WallPulls& pulls,
                      const SeparatedFit& fit);

}  // namespace beaconless
