// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/merge.hpp"
#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/features/split.hpp"
#include "beaconless/geometry/line_fit.hpp"

namespace beaconless {

/// A straight wall, or the part of it that a scan saw.
struct ScanLine {
  ScanSegment beams;  ///< on a full circle it may run over the end; may bridge a few beams without a hit
  LineFit fit;        ///< sensor frame; rms_m weighted as the fit was
  Eigen::Vector2d a = Eigen::Vector2d::Zero();  ///< where the first beam meets the line, nearest point
  Eigen::Vector2d b = Eigen::Vector2d::Zero();  ///< … the last

  double length_m() const { return (b - a).norm(); }
};

/// How lines are found in a scan.
struct LinesConfig {
  double sigma_m = 0.01;                    ///< range noise; what it should be is asked once, here
  bool is_segmented_first = true;           ///< or is the whole scan split at once?
  DistanceSegmentationConfig segmentation;  ///< its sigma_m is the one above
  double split_sigma = 5.0;                 ///< points further than this many sigmas from a chord cut it …
  double split_least_m = 0.03;              ///< … but never those nearer than this
  bool is_cut_again = true;                 ///< lines that two fit far better are cut where that is best
  bool is_merged = true;
  MergeConfig merging;      ///< its sigma_m is the one above
  int refine_passes = 2;    ///< how often ends of neighbours are moved to where their lines cross
  double trim_sigma = 4.0;  ///< end beams further than this from their line are left out
  int min_beams = 4;
  double min_length_m = 0.05;
  double least_incidence_deg = 3.0;  ///< lines that every beam grazes more flatly are no walls but edges
  BeamWeight weight = BeamWeight::radial;  ///< of `tls`; the other methods have none
  LineFitConfig fit;                       ///< its sigma_m is the one above
};

void describe(Fields& fields, LinesConfig& config);

/// A line as it was before its ends are moved.
struct DrawnLine {
  PrincipalLine line;
  double mean_square_m2 = 0.0;  ///< of the distances from it
};

/// Buffers that live on from scan to scan.
struct LinesScratch {
  DistanceSegmentationScratch segmentation;
  SplitScratch splitting;
  OrderedPointsScratch points;
  LineSums sums;
  LineFitScratch fit;
  std::vector<ScanSegment> segments;
  std::vector<ScanSegment> pieces;
  std::vector<PlaceRun> runs;
  std::vector<PlaceRun> uncut;
  std::vector<DrawnLine> lines;
  std::vector<Eigen::Vector2d> run_points;
};

/// The straight walls in a scan, in the order of their beams; each beam belongs to one at most.
///
/// Segmentation, split, merge; then neighbours whose lines cross next to where they meet are parted by the
/// bearing of that crossing, beams at ends that do not lie on their line are left out, and the lines are
/// fitted once more. Out: sensor frame; covariances by sigma_m. Cost: see bench/corners_bench.
///
/// Source: dissertation 3.1 (Algorithms 1 to 4). Differs: vertices of a split are noisy beams and may be off
/// by several; which side of a corner a beam lies on is told by its bearing, which has no noise, so that
/// choosing it does not bias the lines. Epsilon is tied to the noise, not 0.15 to 0.20 m, so that jogs of 5
/// cm remain.
std::vector<ScanLine> find_lines(const Scan& scan, const LinesConfig& config = {});
void find_lines(const Scan& scan, const LinesConfig& config, LinesScratch& scratch,
                std::vector<ScanLine>& lines);

}  // namespace beaconless
