// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/flirt_contour.hpp"
#include "beaconless/features/flirt_curvature.hpp"
#include "beaconless/features/flirt_kernel.hpp"
#include "beaconless/features/flirt_normals.hpp"
#include "beaconless/features/flirt_peaks.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// Which signal along the scan the keypoints are extrema of.
enum class FlirtKind : int {
  range,        ///< second derivative of the ranges: steps and dips
  normal_blob,  ///< second derivative of the wall's direction: where a bend begins and ends
  normal_edge,  ///< first derivative of the wall's direction: the bend itself
  curvature,    ///< how far the contour moves when it is smoothed along itself
};

/// Which of two neighbouring keypoints stays.
enum class FlirtOrder : int {
  strongest,  ///< that with the greater response
  finest,     ///< that of the finer scale, then of the earlier beam, as flirtlib does
};

/// How near is too near.
enum class FlirtSuppression : int {
  disc,  ///< within suppress_m; the same however the sensor is turned
  box,   ///< |dx| and |dy| within suppress_m in sensor axes, as flirtlib does
};

/// Where a keypoint at a step between two surfaces stands. The nearer surface ends there for every viewer;
/// the farther one is cut off elsewhere from elsewhere.
enum class FlirtForeground : int {
  support,    ///< at the near side of the greatest step within the support
  next_beam,  ///< at the next beam, if that is nearer, as flirtlib does; coarse peaks stay behind the step
};

/// FLIRT: what it looks at and what it keeps. Defaults are those of the range detector; see flirt_defaults().
struct FlirtConfig {
  FlirtKind kind = FlirtKind::range;
  FlirtKernel kernel = FlirtKernel::discrete_gaussian;
  double sigma_beams = 1.0;       ///< finest scale of range, blob and edge
  double sigma_m = 0.2;           ///< finest scale of curvature, along the contour
  double scale_step_ratio = 1.4;  ///< from one scale to the next
  int scales_count = 5;
  int window_beams = 3;         ///< points that a normal is fitted to; odd
  double min_response = 0.05;   ///< m for range, rad for blob and edge, t exp(-t) <= 0.3679 for curvature
  double min_prominence = 0.0;  ///< a peak exceeds both neighbours by more than this; same unit
  bool falling_only = false;    ///< only one sign of the response, as flirtlib's edge detector does
  bool peaks_across_scales = false;  ///< a peak also exceeds the neighbouring scales
  FlirtOrder order = FlirtOrder::strongest;
  FlirtSuppression suppression = FlirtSuppression::disc;
  double suppress_m = 0.2;  ///< keypoints are further apart than this
  FlirtForeground foreground = FlirtForeground::support;
  double min_step_m = 0.15;  ///< ranges of neighbouring beams that differ by more belong to two surfaces
  double max_gap_m = 0.0;    ///< curvature: consecutive points further apart end a contour; 0: none does

  friend bool operator==(const FlirtConfig&, const FlirtConfig&) = default;
};

void describe(Fields& fields, FlirtConfig& config);

/// The defaults of one kind.
FlirtConfig flirt_defaults(FlirtKind kind);

/// The parameters of flirtlib's command line tools, with the quirks that can be reproduced: Bessel kernels of
/// variance sigma cut at one sigma, sigma 1.6 beams for range and 0.2 beams for blob and edge (all scales
/// then have three taps), a window of 3 points, 0.2 m for curvature, peaks of 0.34 by 0.001, the finest of
/// two neighbours in a box of 0.2 m, edges of one sign only.
/// Source: flirtlib @f608c8c, RansacLoopClosureTest.cpp.
FlirtConfig flirtlib_tools(FlirtKind kind);

/// Buffers that live on from call to call.
struct FlirtScratch {
  FlirtConfig prepared_for;  ///< whose kernels these are
  std::vector<ScaleKernel> kernels;
  FlirtContour contour;
  std::vector<float> signal;                 ///< one value a point of the contour
  std::vector<std::vector<float>> smooth;    ///< one array a scale
  std::vector<std::vector<float>> response;  ///< one array a scale
  std::vector<FlirtPeak> peaks;
  NormalScratch normals;
  std::vector<float> padded;
  CurvatureScratch curvature;
  std::vector<std::vector<float>> move_x_m;  ///< curvature: one array a scale
  std::vector<std::vector<float>> move_y_m;
  std::vector<float> kept_x_m, kept_y_m;  ///< of the keypoints so far
};

/// Finds the keypoints of one scan that are extrema over place and scale.
///
/// Out: keypoints in the sensor frame, the first to be kept first. orientation_rad is the direction of the
/// wall's normal away from the sensor (range: of the support), for curvature the direction into the bend;
/// scale_m the radius of the support (2 sigma for curvature), score the magnitude of the response. Never
/// throws; scans without hits have no keypoints. Cost: points x scales x taps; see bench/flirt_bench.
///
/// Source: Tipaldi and Arras, "FLIRT - Interest regions for 2D range data", ICRA 2010.
/// Differs from flirtlib: (1) a beam without a hit ends a contour, so that beams that are not neighbours
/// never become such; (2) a full circle has no ends; (3) sigma is a standard deviation and the kernels reach
/// as far as they weigh anything; (4) of several peaks at one place the strongest stays, not the finest;
/// (5) the distance between keypoints does not depend on the heading; (6) both signs of an edge count, or a
/// room's own corners would be left out; (7) contours shorter than a kernel are smoothed within themselves;
/// (8) curvature: see flirt_curvature.hpp.
std::vector<Keypoint> detect_flirt(const Scan& scan, const FlirtConfig& config = {});

/// The same without asking for memory once the buffers have grown.
void detect_flirt(const Scan& scan, const FlirtConfig& config, FlirtScratch& scratch,
                  std::vector<Keypoint>& keypoints);

}  // namespace beaconless
