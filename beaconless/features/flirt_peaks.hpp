// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "beaconless/features/flirt_contour.hpp"
#include "beaconless/features/flirt_kernel.hpp"

namespace beaconless {

/// An extremum of the response.
struct FlirtPeak {
  float strength = 0.0F;    ///< magnitude of the response
  std::uint32_t scale = 0;  ///< 0 is the finest
  std::uint32_t point = 0;  ///< of the contour
  std::uint32_t stretch = 0;
};

/// What makes an extremum a peak; see FlirtConfig.
struct FlirtPeakRule {
  float min_response = 0.0F;
  float min_prominence = 0.0F;
  bool falling_only = false;
  bool across_scales = false;
};

/// t (S[i-1] - 2 S[i] + S[i+1]) of a smoothed signal, t the kernel's variance; 0 at the ends.
/// Source: scale-normalised second derivative, Lindeberg 1998, eq. 20 (gamma = 1).
void second_derivative(std::span<const float> smooth, const ScaleKernel& kernel, std::span<float> response);

/// sqrt(t) (S[i-1] - S[i+1]) / 2: positive where the signal falls; 0 at the ends.
void first_derivative(std::span<const float> smooth, const ScaleKernel& kernel, std::span<float> response);

/// Adds the peaks of all scales on one stretch, finest scale first, in order of the contour.
///
/// Near the ends of an open stretch, nearer than the kernel is wide (its sigma), there are none.
void find_peaks(std::span<const std::vector<float>> response, std::span<const ScaleKernel> kernels,
                const FlirtStretch& stretch, std::uint32_t stretch_index, const FlirtPeakRule& rule,
                std::vector<FlirtPeak>& peaks);

}  // namespace beaconless
