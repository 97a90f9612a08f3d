// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "beaconless/features/flirt_contour.hpp"
#include "beaconless/features/flirt_kernel.hpp"

namespace beaconless {

/// Buffers of measure_contour() and contour_moves().
struct CurvatureScratch {
  std::vector<float> along_m;       ///< arc length, one a point of the contour
  std::vector<float> weight, x, y;  ///< cells, evenly spaced along one stretch
  std::vector<float> smooth_weight, smooth_x, smooth_y;
  std::vector<float> padded;
};

/// Cells in one sigma of the kernel that contour_moves() wants.
inline constexpr double kCellsPerSigma = 8.0;

/// Arc length from the beginning of each stretch to each of its points: the shortest way that leaves out at
/// most two points at a time.
///
/// Near walls points are nearer together than the ranges are noisy, and the way from point to point zigzags
/// to several times the wall's length; the links of three spanning trees let flirtlib cut such corners, too.
/// A link counts for `longest_m` at most: 4 sigma are as far apart for the kernel as 40, at a tenth of the
/// cells.
void measure_contour(const FlirtContour& contour, double longest_m, CurvatureScratch& scratch);

/// How far each point of a stretch moves when the stretch is smoothed along itself by `sigma_m`, in metres.
///
/// Weights are Gaussian in arc length and divided by the density of the points, so that their spacing does
/// not count. In: measure_contour() done; `kernel` with a sigma of kCellsPerSigma. Out: one value a point of
/// the contour, set on the stretch only. Cost: points + length / sigma x taps, not points squared.
///
/// Source: Tipaldi and Arras 2010, III-C; density normalisation: Coifman and Lafon, "Diffusion maps", 2006,
/// alpha = 1. Differs: flirtlib builds three spanning trees of the complete graph, all shortest paths and an
/// n x n matrix on the stack (9.3 MB for 1081 beams). Along one contour shortest paths are differences of
/// arc lengths, points fall into cells of an eighth of sigma, and the sums become convolutions. What is lost
/// are links across the contour, as from the end of a near surface to the wall behind it.
void contour_moves(const FlirtContour& contour, const FlirtStretch& stretch, double sigma_m,
                   const ScaleKernel& kernel, CurvatureScratch& scratch, std::span<float> move_x_m,
                   std::span<float> move_y_m);

}  // namespace beaconless
