// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/line_sums.hpp"
#include "beaconless/features/ordered_points.hpp"
#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// When two neighbouring pieces are one line.
struct MergeConfig {
  double sigma_m = 0.01;     ///< range noise
  double chi_square = 12.0;  ///< by how much one line may fit worse than two; two degrees of freedom pass it
                             ///< by chance once in 400
  int bridge_beams = 3;      ///< beams between two pieces that may belong to neither
};

void describe(Fields& fields, MergeConfig& config);

/// Buffers that live on from scan to scan.
struct MergeScratch {
  OrderedPointsScratch points;
  LineSums sums;
  std::vector<PlaceRun> runs;
};

/// Joins neighbouring pieces of a scan that one line explains as well as two: the second half of
/// split-and-merge.
///
/// In: pieces in order, as `split` gives them; they may share a beam or have a few beams between them. Out:
/// the same order; on a full circle the last and the first piece are neighbours too. Cost: O(beams + pieces).
///
/// Two pieces are joined when chi² of the joint fit exceeds the sum of theirs by no more than the threshold,
/// in units of the residuals met where those are larger than sigma says. Source: Pavlidis and Horowitz 1974;
/// chi² of weighted total least squares. Differs: usual is a threshold on the joint residual alone, which a
/// long wall fails by noise and two short pieces with a bend pass.
std::vector<ScanSegment> merge(const Scan& scan, std::span<const ScanSegment> pieces,
                               const MergeConfig& config = {});
void merge(const Scan& scan, std::span<const ScanSegment> pieces, const MergeConfig& config,
           MergeScratch& scratch, std::vector<ScanSegment>& merged);

/// The beam after which two lines fit a run better than one by more than the threshold allows to merge; the
/// run's last where none does. A side may be a beam or two that lie
/// off. Cost: some 30 fits in O(1).
std::size_t best_cut(const LineSums& sums, const MergeConfig& config, PlaceRun run);

/// The same on sums that are there already, in place.
void merge_runs(const OrderedPoints& points, const LineSums& sums, const MergeConfig& config,
                std::vector<PlaceRun>& runs);

}  // namespace beaconless
