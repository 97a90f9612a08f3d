// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/match/wall_beams.hpp"
#include "beaconless/match/wall_separation.hpp"

namespace beaconless {

/// What a beam is taken to know, and which beams are believed.
struct WallsConfig {
  double sigma_m = 0.01;       ///< range noise of the laser …
  double sigma_per_m = 0.0;    ///< … and what it grows by with the range
  double footprint_rad = 0.0;  ///< half the divergence of a beam: at a slant it sees a piece of the wall
  double map_sigma_m = 0.0;    ///< by how much the map's walls are off; what the residuals tell is added
  double gate_m = 0.3;         ///< from a rough guess, beams that end further from every wall are left out
  double near_gate_m = 0.05;   ///< the same from a good one, unless the noise is larger
  double cut_sigma = 6.0;      ///< beams this many standard deviations from their wall know nothing
  double max_incidence_deg = 88.0;     ///< beams that graze a wall more than this are left out
  double on_map_m = 0.10;              ///< a point this near to a wall counts as explained by the map
  double unobservable_sigma_m = 0.25;  ///< a direction less certain than this is held at the guess
  int min_pairs = 12;
  ProtectionConfig protection;
};

void describe(Fields& fields, WallsConfig& config);

/// Buffers that live on from call to call, so that a match allocates nothing.
struct WallsScratch {
  WallBeams beams;
  WallMarks marks;
  std::vector<WallPiece> pieces;
  std::vector<WallPiece> lines;  ///< the pieces of each added up
  std::vector<Eigen::Vector2d> thinned;
};

/// Fits the beams of a scan to the walls that they hit: maximum likelihood of the pose, from a guess that is
/// good to `prior_m`.
///
/// In: ends of beams in the laser frame (m). Out: map_from_laser with covariance; `scale_m` is the measured
/// standard deviation of a range. Cost: one look-up of a wall a beam, two or three loops over the beams.
/// Source: Censi, ICRA 2007 (the residual along the beam, its slope and bound). Differs: a beam is paired
/// with the first wall that it meets near its end instead of by casting it from the laser; Tukey's weights,
/// and a scale that is measured from the residuals and narrows from step to step (graduated non-convexity
/// after Yang et al., RA-L 2020).
MatchResult match_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls, const Pose2& guess,
                        double prior_m, const WallsConfig& config, WallsScratch& scratch);

}  // namespace beaconless
