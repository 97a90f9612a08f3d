// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace beaconless {

/// The family of smoothing kernels.
enum class FlirtKernel : int {
  sampled_gaussian,   ///< exp(-n^2 / (2 sigma^2)) at the beams
  discrete_gaussian,  ///< exp(-t) I_n(t) with t = sigma^2: smoothing on a grid that makes no new extrema
  flirtlib_bessel,    ///< the same with t = sigma and cut at ceil(sigma) beams, as flirtlib does
};

/// One smoothing kernel and what its derivatives are multiplied by.
///
/// Kernels are symmetric: `weights[n]` is that of the samples n before and n behind; all of them sum to 1.
struct ScaleKernel {
  double sigma = 0.0;     ///< as configured: beams, or metres for curvature
  double variance = 0.0;  ///< of the kernel before it is cut: sigma^2, or sigma for flirtlib_bessel
  std::vector<float> weights;

  std::size_t half_width() const { return weights.size() - 1; }
};

/// The kernel of one scale, in beams.
///
/// Reaches 3 sigma (flirtlib_bessel: ceil(sigma)), at least one beam. Source: Lindeberg, "Scale-space for
/// discrete signals", PAMI 1990, eq. 19; Bessel functions by Miller's backward recurrence. Differs: flirtlib
/// calls its parameter sigma but hands it to the Bessel kernel as the variance t, so that its scales are
/// sqrt(sigma) wide; its factors sigma and sqrt(sigma) before the derivatives are right for that reading
/// (t L_xx, sqrt(t) L_x). Here the variance is sigma^2 and so are the factors; flirtlib_bessel is the old
/// way.
ScaleKernel make_scale_kernel(FlirtKernel kind, double sigma_beams);

/// Smooths `signal`, of which `kernel` sees the end values repeated beyond its ends.
///
/// Cost: samples x half width, vectorised. `padded` is scratch; `smooth` gets as many values as `signal` has.
void smooth_signal(std::span<const float> signal, const ScaleKernel& kernel, std::vector<float>& padded,
                   std::span<float> smooth);

}  // namespace beaconless
