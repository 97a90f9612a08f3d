// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/features/split.hpp"
#include "beaconless/geometry/circle_fit.hpp"

namespace beaconless {

/// A round column, or the part of it that a scan saw.
struct ScanCircle {
  ScanSegment beams;
  CircleFit fit;         ///< sensor frame; covariance for noise along the beams
  double arc_rad = 0.0;  ///< how much of the circle was seen
};

/// When some beams in a row are a round column.
struct CirclesConfig {
  double sigma_m = 0.01;                    ///< range noise
  DistanceSegmentationConfig segmentation;  ///< its sigma_m is the one above
  double split_sigma = 5.0;                 ///< where the ends of a column may be: as in LinesConfig
  double min_radius_m = 0.03;
  double max_radius_m = 1.0;
  double min_arc_deg = 80.0;
  int min_beams = 8;
  double max_rms_sigma = 1.5;         ///< beams of a column stray no more than this from the circle
  double min_gain_chi_square = 16.0;  ///< by how much two lines must fit worse
};

void describe(Fields& fields, CirclesConfig& config);

/// Buffers that live on from scan to scan.
struct CirclesScratch {
  DistanceSegmentationScratch segmentation;
  SplitScratch splitting;
  OrderedPointsScratch points;
  std::vector<ScanSegment> segments;
  std::vector<ScanSegment> pieces;
  std::vector<Eigen::Vector2d> run;
};

/// The round columns in a scan, in the order of their beams.
///
/// Runs of neighbouring straight pieces that bulge towards the sensor are fitted with a circle, longest runs
/// first. A run is a column when the circle fits as well as the noise lets it, when enough of it is seen, and
/// when the best two lines fit clearly worse: so neither walls nor corners are columns, nor is anything that
/// is too small or too far away to tell. Cost: one split, and a fit or a few per run that bulges.
///
/// Source: dissertation eq. (2), corrected as `fit_circle` says; covariance H⁻¹ (Σ sigma² cos²b J Jᵀ) H⁻¹,
/// since noise is along the beams and the fit is not weighted.
std::vector<ScanCircle> find_circles(const Scan& scan, const CirclesConfig& config = {});
void find_circles(const Scan& scan, const CirclesConfig& config, CirclesScratch& scratch,
                  std::vector<ScanCircle>& circles);

}  // namespace beaconless
