// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// Which directions of a pose a set of residuals determines: the eigenvectors of their information, with
/// headings measured in metres at the mean arm so that both can be compared.
///
/// In: H = Σ w J Jᵀ of (x, y, theta), the root mean square distance of the points from the laser, the
/// standard deviation of a residual (1 where H is whitened already) and what a direction may be uncertain by.
/// A direction less certain than that is weak: steps along it are left out, so that what is not seen stays at
/// the guess. Source: Zhang, Kaess and Singh, "On degeneracy of optimization-based state estimation
/// problems", ICRA 2016. Differs: the threshold is a standard deviation in metres, not an eigenvalue.
struct Observability {
  Eigen::Matrix3d directions;     ///< columns, least certain first, in (m, m, rad)
  Eigen::Matrix3d to_components;  ///< its inverse
  Eigen::Vector3d hessian;        ///< eigenvalues
  int weak_count = 0;

  Observability(const Eigen::Matrix3d& full, double arm_m, double sigma, double unobservable_sigma_m) {
    const Eigen::DiagonalMatrix<double, 3> to_metres(1.0, 1.0, 1.0 / arm_m);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        Eigen::Matrix3d(to_metres * full * to_metres));
    directions = to_metres * solver.eigenvectors();
    to_components = solver.eigenvectors().transpose() * to_metres.inverse();
    hessian = solver.eigenvalues();
    const double least = sigma * sigma / (unobservable_sigma_m * unobservable_sigma_m);
    while (weak_count < 3 && !(hessian[weak_count] > least)) ++weak_count;
  }

  /// A step without what it moves along weak directions.
  Eigen::Vector3d determined(const Eigen::Vector3d& step) const {
    Eigen::Vector3d components = to_components * step;
    components.head(weak_count).setZero();
    return directions * components;
  }

  /// H⁻¹ along the determined directions only.
  Eigen::Matrix3d inverse() const {
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    for (int k = weak_count; k < 3; ++k)
      inverse += directions.col(k) * directions.col(k).transpose() / hessian[k];
    return inverse;
  }

  /// What nothing is known about: kUnknownSigma² along the weak directions.
  Eigen::Matrix3d unknown() const {
    Eigen::Matrix3d unknown = Eigen::Matrix3d::Zero();
    for (int k = 0; k < weak_count; ++k)
      unknown += MatchResult::kUnknownSigma * MatchResult::kUnknownSigma * directions.col(k) *
                 directions.col(k).transpose();
    return unknown;
  }
};

}  // namespace beaconless
