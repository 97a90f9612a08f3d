// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::eval {

/// The normalised estimation error squared, eᵀ P⁻¹ e: how large an error is in the estimate's own opinion.
///
/// 3 on average when the covariance is honest. The heading's error is wrapped. Nothing when the covariance is
/// not positive definite. Source: Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and
/// Navigation", 5.4.2.
std::optional<double> nees(const Pose2& estimate, const Eigen::Matrix3d& covariance, const Pose2& truth);

/// Whether many estimates know how good they are.
struct Consistency {
  double mean_nees = 0.0;
  double low = 0.0;  ///< the mean of honest, independent estimates lies between these two 95 times out of 100
  double high = 0.0;
  std::size_t count = 0;
  std::size_t singular_count = 0;  ///< estimates whose covariance is not positive definite

  /// "consistent", "too sure" (errors larger than they are said to be), "too careful", or "unknown" without
  /// estimates.
  std::string_view verdict() const;

  friend bool operator==(const Consistency&, const Consistency&) = default;
};

/// NEES of the estimates that are ok() and have a truth at their stamp.
///
/// Estimates that share errors (a standing robot's with a biased map, say) are not independent: the band is
/// then too narrow.
Consistency consistency_of(std::span<const PoseEstimate> estimates, const Trajectory& truth,
                           double max_gap_s = 1.0);

}  // namespace beaconless::eval
