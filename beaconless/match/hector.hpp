// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/occupancy_pyramid.hpp"
#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// Gauss-Newton on an occupancy pyramid: how long and how far.
struct HectorConfig {
  int coarse_iterations = 4;    ///< steps on each level but the finest; hector_slam's 1 + 3
  int fine_iterations = 6;      ///< steps on the finest level; hector_slam's 1 + 5
  double max_turn_rad = 0.2;    ///< of one step
  double max_step_cells = 2.0;  ///< of one step, in cells of its level
  double damping = 1e-3;        ///< added to the diagonal of H, as a share of it
  double converged_m = 0.0;  ///< a shorter step ends a level, if it also turns little; 0: all steps are taken
  double converged_rad = 1e-6;         ///< a smaller turn ends a level, if it also moves little
  double sigma_m = 0.01;               ///< range noise of the laser; no residual is believed to be smaller
  double unobservable_sigma_m = 0.25;  ///< a direction less certain than this is held at the guess
  double on_map_m = 0.10;              ///< a point this near to a wall counts as explained by the map
  int min_pairs = 12;                  ///< fewer points near walls make no match
};

void describe(Fields& fields, HectorConfig& config);

/// Buffers that live on from call to call, so that a match allocates nothing.
struct HectorScratch {
  std::vector<float> x_m;  ///< the points that can be used, padded to whole lanes
  std::vector<float> y_m;
};

/// Fits the points of a scan onto an occupancy pyramid, from a guess nearby.
///
/// In: points in the laser frame (m). Out: map_from_laser with covariance. Minimises Σ (1 - M(T p))² by
/// Gauss-Newton, coarse to fine. Cost: points x steps x one load; see bench/hector_bench. Status:
/// too_few_pairs leaves the guess; never throws, never NaN.
MatchResult match_hector(std::span<const Eigen::Vector2d> points, const OccupancyPyramid& map,
                         const Pose2& guess, const HectorConfig& config, HectorScratch& scratch);

}  // namespace beaconless
