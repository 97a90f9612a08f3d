// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/features/flirt_kernel.hpp"

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

}  // namespace beaconless
