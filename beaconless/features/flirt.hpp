// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/features/flirt_config.hpp"
#include "beaconless/features/flirt_contour.hpp"
#include "beaconless/features/flirt_curvature.hpp"
#include "beaconless/features/flirt_kernel.hpp"
#include "beaconless/features/flirt_normals.hpp"
#include "beaconless/features/flirt_peaks.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

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
/// (8) at a step coarse peaks, too, move to its near side; (9) curvature: see flirt_curvature.hpp.
/// flirtlib_tools() brings back (3) to (6) and (8). docs/concepts/flirt-agreement.md has the figures.
std::vector<Keypoint> detect_flirt(const Scan& scan, const FlirtConfig& config = {});

/// The same without asking for memory once the buffers have grown.
void detect_flirt(const Scan& scan, const FlirtConfig& config, FlirtScratch& scratch,
                  std::vector<Keypoint>& keypoints);

}  // namespace beaconless
