// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/occupancy_pyramid.hpp"
#include "beaconless/match/hector_sums.hpp"
#include "beaconless/match/match_result.hpp"

namespace beaconless {

/// The HectorSLAM matcher: how many steps, how long, and what they may use.
struct HectorConfig {
  int coarse_iterations = 4;    ///< steps on every level but the finest; hector_slam's 1 + 3
  int fine_iterations = 6;      ///< steps on the finest; hector_slam's 1 + 5
  bool stops_early = false;     ///< a level ends when a step is below the next two; else all steps are taken
  double converged_m = 1e-4;    ///< a match converged if its last step moved the laser less than this …
  double converged_rad = 1e-4;  ///< … and turned it less than this
  double max_turn_rad = 0.2;    ///< in one step
  double max_step_cells = 2.0;  ///< in one step, of its level's cells
  double sigma_m = 0.01;        ///< range noise of the laser; residuals are not believed to be smaller
  double least_share = 0.02;    ///< a direction with less of all that the walls hold is held at the guess
  double on_map_m = 0.10;       ///< a point this near to a wall counts as explained by the map
  int min_pairs = 12;           ///< fewer points near walls make no match
};

void describe(Fields& fields, HectorConfig& config);

/// Buffers that live on from call to call, so that a match allocates nothing.
struct HectorScratch {
  HectorPoints points;
  VectorLoop loop = fastest_vector_loop();
};

/// Fits the points of a scan onto a map of cells, from a guess nearby: Gauss-Newton on Σ (1 - M)², from the
/// coarsest level to the finest.
///
/// In: points in the laser frame (m), in the order of the scan. Out: map_from_laser. Points further than a
/// cell or two of the finest level from every wall pull on nothing in the end, which makes people harmless.
/// covariance: σ² H⁻¹ in metres and radians, σ² the mean square residual of the points, each counted as it
/// pulls, H freed of the ripple of drawn walls (see held_by_walls in the .cpp), plus the map's wall_sigma_m.
/// It is honest while the range noise is well below a cell and the map's walls are where it says.
/// on_map_ratio, misfit: from the finest level that reaches on_map_m; 1 - M there is about the distance.
/// Cost: points x steps x one load; see bench/hector_bench. Status: too_few_pairs leaves the guess (no pose
/// for one that is not finite); never throws, never NaN.
///
/// Source: Kohlbrecher et al., SSRR 2011; dissertation 2.4.2. Differs: (1) printed there, H lacks the sum
/// over the points; (2) hector_slam's slope of M is wrong beside oblique walls, see sum_hector(); (3) it
/// publishes H as the covariance, in cells; (4) it solves with whatever H it finds, and so drifts along a
/// corridor: here directions that walls do not hold stay at the guess; (5) for the values of M, see
/// OccupancyLevel and wall_value().
MatchResult match_hector(std::span<const Eigen::Vector2d> points, const OccupancyPyramid& map,
                         const Pose2& guess, const HectorConfig& config, HectorScratch& scratch);

}  // namespace beaconless
