// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/features/flirt_contour.hpp"
#include "beaconless/features/flirt_kernel.hpp"

namespace beaconless {

/// Buffers of contour_bend().
struct CurvatureScratch {
  std::vector<float> along_m;                   ///< arc length, one a point of the contour
  std::vector<float> x, y, smooth_x, smooth_y;  ///< samples of one stretch, evenly spaced along it
  std::vector<float> padded;
};

/// Arc length from the beginning of each stretch to each of its points.
void measure_contour(const FlirtContour& contour, CurvatureScratch& scratch);

/// How far each point of a stretch moves when the contour is smoothed along itself by `sigma_m`, m.
///
/// The stretch is sampled evenly, sigma / 8 apart, and smoothed by a Gaussian of 8 samples; `kernel` is that
/// Gaussian. In: measure_contour() done. Out: move_x_m, move_y_m, one value a point of the contour, set on
/// the stretch only. Cost: O(length / sigma x taps), whatever the number of points.
///
/// Source: Tipaldi and Arras 2010, III-C; Lafon, "Diffusion maps and geometric harmonics", 2004: dividing
/// the weights by the densities makes them a smoothing along the curve, whatever the spacing of the points.
/// Differs: flirtlib builds three spanning trees of the complete graph, all-pairs shortest paths and an n x n
/// matrix on the stack (9.3 MB for 1081 beams). Along one contour shortest paths are arc lengths and the
/// density-free average is a convolution.
void contour_moves(const FlirtContour& contour, const FlirtStretch& stretch, double sigma_m,
                   const ScaleKernel& kernel, CurvatureScratch& scratch, std::span<float> move_x_m,
                   std::span<float> move_y_m);

/// Samples in one sigma of the kernel that contour_moves() wants.
inline constexpr double kSamplesPerSigma = 8.0;

}  // namespace beaconless
