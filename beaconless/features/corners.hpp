// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/features/lines.hpp"

namespace beaconless {

/// Where two walls meet.
struct Corner {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();       ///< sensor frame; between beams
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of point, m²
  double angle_rad = 0.0;        ///< between the two walls as they leave the corner, in (0, pi)
  double orientation_rad = 0.0;  ///< of the bisector, from the corner between both walls; in [-pi, pi)
  bool is_convex = false;       ///< juts out towards the sensor, as the edge of a box; else as that of a room
  std::size_t first_line = 0;   ///< the wall on the side of lower bearings …
  std::size_t second_line = 0;  ///< … and the other, as places in the list of lines
  std::size_t beam = 0;         ///< the nearest of the beams that met either wall
  double gap_m = 0.0;  ///< how much further from it a wall ends than the next beam can tell; see find_corners
  double arm_m = 0.0;  ///< length of the shorter wall
  double score = 0.0;  ///< 1 / standard deviation in the worst direction, 1/m
};

/// When two lines make a corner.
struct CornersConfig {
  LinesConfig lines;
  double min_angle_deg = 25.0;  ///< between the lines
  double reach_beams = 4.0;    ///< how far from the corner a wall may end, in distances between its beams …
  double behind_beams = 0.5;   ///< how far behind the corner it may still be seen, likewise …
  double reach_sigma = 3.0;    ///< … both plus sigmas of the range noise …
  double reach_most_m = 0.35;  ///< … but never further than this
  double min_arm_m = 0.15;     ///< shorter walls make no corner
  double max_sigma_m = 0.02;   ///< corners less certain than this in any direction are left out
  bool is_round_left_out = true;  ///< no corner where a round column explains both walls as well
};

void describe(Fields& fields, CornersConfig& config);

/// As the dissertation found corners: constant distance threshold and epsilon, plain least squares, no
/// merging, walls further apart than 45° and ends nearer than 0.1 m. Source: dissertation 3.1, 4.3 and
/// Algorithm 5.
CornersConfig corners_of_the_dissertation();

/// Buffers that live on from scan to scan.
struct CornersScratch {
  LinesScratch finding;
  std::vector<ScanLine> lines;
  std::vector<Eigen::Vector2d> points;
};

/// The corners of a scan: crossings of lines that follow each other and end there.
///
/// Out: in the order of their beams; with `lines`, the lines they refer to. The covariance is that of the two
/// lines, N⁻¹ diag(v1, v2) N⁻ᵀ with the normals as rows of N, and honest (NEES 2) for range noise of sigma_m.
/// Where a cupboard stands a hand's breadth before a wall, its side and the wall cross at a place that is as
/// fixed as any corner but where nothing is. As long as the beams there are further apart than that gap,
/// nobody can tell; `gap_m` above three sigmas says that the walls may not touch. Those with less are corners
/// for sure but come and go with the beams, which is why the default lets some of the others in.
///
/// Cost: see bench/corners_bench, no allocation with a scratch.
///
/// Source: dissertation 3.1, Algorithm 5. Differs: (1) normal forms, since slopes divide by zero for vertical
/// lines and the printed angle does for perpendicular ones; (2) the crossing must lie near the facing ends of
/// both lines, else a far extrapolation passes; this also refuses edges where one wall hides another; (3) how
/// near grows with the distance between beams on the wall, r Δθ / cos b, because a fixed 0.1 m is less than
/// that spacing at 30 m and refuses every far corner; (4) the last line meets the first one on a full circle.
std::vector<Corner> find_corners(const Scan& scan, const CornersConfig& config = {});
std::vector<Corner> find_corners(const Scan& scan, const CornersConfig& config, std::vector<ScanLine>& lines);
void find_corners(const Scan& scan, const CornersConfig& config, CornersScratch& scratch,
                  std::vector<Corner>& corners);

/// When lines that do not follow each other make a corner.
struct CrossingsConfig {
  double min_angle_deg = 45.0;
  double max_gap_m = 0.5;     ///< from the crossing to the nearer end of each line
  double max_sigma_m = 0.05;  ///< crossings less certain than this in any direction are left out
};

void describe(Fields& fields, CrossingsConfig& config);

/// Corners that the scan did not see itself, because something stood before them: crossings of any two lines
/// that both end near by, unless the scan looks through the place.
///
/// In: lines of that scan. Out: those of `find_corners` too, as far as they fulfil this config; by first
/// line, then by second. Cost: O(lines²). Source: dissertation 3.1, last paragraph: "the intersection between
/// all segments and, for that reason, a distance condition is mandatory".
std::vector<Corner> find_crossings(const Scan& scan, std::span<const ScanLine> lines,
                                   const CrossingsConfig& config = {});
void find_crossings(const Scan& scan, std::span<const ScanLine> lines, const CrossingsConfig& config,
                    std::vector<Corner>& corners);

/// The corner as a keypoint: its scale is the length of the shorter wall.
Keypoint keypoint_of(const Corner& corner);

}  // namespace beaconless
