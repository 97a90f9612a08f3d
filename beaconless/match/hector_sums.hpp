// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/occupancy_level.hpp"
#include "beaconless/match/vector_loop.hpp"

namespace beaconless {

/// Points as a loop over many at once wants them.
struct HectorPoints {
  static constexpr std::size_t kLanes = 8;

  std::vector<float> x_m;  ///< laser frame; filled up to whole lanes with points outside of any map
  std::vector<float> y_m;
  std::size_t count = 0;
  double arm_m = 0.0;  ///< root mean square distance from the laser

  /// Takes the points that are finite and within 10 km. Allocates only to hold more than ever before.
  void load(std::span<const Eigen::Vector2d> points);
};

/// The sums of one Gauss-Newton step on Σ (1 - M)², with 1 - M measured in lengths of cells.
///
/// J is the slope of M, times the length of a cell, by (x, y, theta) of the laser along the grid's axes.
struct HectorSums {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();   ///< Σ J Jᵀ
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< Σ J (1 - M) length; the step is H⁻¹ of it
  int near_count = 0;                                  ///< points with M above 0
};

/// How well points fit at a pose.
struct HectorFit {
  int near_count = 0;       ///< points with M above `least`
  double misfit_sum = 0.0;  ///< Σ min(1, ((1 - M) / (1 - least))²)
  double pull_m2 = 0.0;     ///< Σ |J|² ((1 - M) length)², J by (x, y) alone
  double slope_sum = 0.0;   ///< Σ |J|²
};

/// Sums over all points at a pose of the laser in the level's grid.
///
/// In: a finite pose; a loop that this processor knows. Points outside count as where M is 0. Cost: one load
/// of a word and some 70 operations a point, four or eight points at once. Source: Kohlbrecher et al., SSRR
/// 2011, eqs. 4-13. Differs: hector_slam blends the differences in x by the share in x, and those in y by
/// that in y (issue 16 there); that is the slope of M only beside walls along the rows.
HectorSums sum_hector(const HectorPoints& points, const OccupancyLevel& level, const Pose2& grid_from_laser,
                      VectorLoop loop);

/// The same way, for 0 <= least < 1.
HectorFit fit_hector(const HectorPoints& points, const OccupancyLevel& level, const Pose2& grid_from_laser,
                     double least, VectorLoop loop);

}  // namespace beaconless
