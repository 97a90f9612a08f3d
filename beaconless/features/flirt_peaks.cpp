// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_peaks.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace beaconless {
namespace {

constexpr int kBlock = 16;

/// Whether `value`, made positive by `sign`, is above its three neighbours on another scale.
bool above(float value, float sign, const std::vector<float>& other, std::size_t i) {
  return value >= sign * other[i - 1] && value >= sign * other[i] && value >= sign * other[i + 1];
}

bool is_peak(std::span<const std::vector<float>> response, std::size_t scale, std::size_t i,
             const FlirtPeakRule& rule) {
  // 1. Strong enough and above its neighbours along the scan? In one question, as each of the answers alone
  // is hard to predict for the processor.
  const std::vector<float>& here = response[scale];
  const float sign = here[i] > 0.0F ? 1.0F : -1.0F;
  const float strength = sign * here[i];
  const float prominence = std::min(strength - sign * here[i - 1], strength - sign * here[i + 1]);
  if (!(std::min(strength - rule.min_response, prominence - rule.min_prominence) > 0.0F)) return false;
  // 2. Of an allowed sign …
  if (rule.falling_only && sign < 0.0F) return false;
  // 3. … and on the scales next to its own?
  if (!rule.across_scales) return true;
  if (scale > 0 && !above(strength, sign, response[scale - 1], i)) return false;
  return scale + 1 == response.size() || above(strength, sign, response[scale + 1], i);
}

}  // namespace

void second_derivative(std::span<const float> smooth, const ScaleKernel& kernel, std::span<float> response) {
  const auto factor = static_cast<float>(kernel.variance);
  if (smooth.empty()) return;
  for (std::size_t i = 1; i + 1 < smooth.size(); ++i)
    response[i] = factor * (smooth[i - 1] - 2.0F * smooth[i] + smooth[i + 1]);
  response.front() = response.back() = 0.0F;
}

void first_derivative(std::span<const float> smooth, const ScaleKernel& kernel, std::span<float> response) {
  const auto factor = static_cast<float>(0.5 * std::sqrt(kernel.variance));
  if (smooth.empty()) return;
  for (std::size_t i = 1; i + 1 < smooth.size(); ++i) response[i] = factor * (smooth[i - 1] - smooth[i + 1]);
  response.front() = response.back() = 0.0F;
}

void find_peaks(std::span<const std::vector<float>> response, std::span<const ScaleKernel> kernels,
                const FlirtStretch& stretch, std::uint32_t stretch_index, const FlirtPeakRule& rule,
                std::vector<FlirtPeak>& peaks) {
  for (std::size_t scale = 0; scale < kernels.size(); ++scale) {
    // 1. Which points: with both neighbours, and away from open ends.
    const std::size_t margin =
        stretch.closed ? 0 : static_cast<std::size_t>(std::ceil(kernels[scale].sigma)) + 1;
    const std::size_t begin = stretch.core_begin + margin;
    const std::size_t end = stretch.core_end > begin + margin ? stretch.core_end - margin : begin;
    // 2. Those of them that are peaks; most blocks hold nothing that is strong enough.
    for (std::size_t block = begin; block < end; block += kBlock) {
      const std::size_t block_end = std::min<std::size_t>(block + kBlock, end);
      const Eigen::Map<const Eigen::ArrayXf> values(response[scale].data() + block,
                                                    static_cast<Eigen::Index>(block_end - block));
      if (!(values.abs().maxCoeff() > rule.min_response)) continue;
      for (std::size_t i = block; i < block_end; ++i)
        if (is_peak(response, scale, i, rule))
          peaks.push_back({std::abs(response[scale][i]), static_cast<std::uint32_t>(scale),
                           static_cast<std::uint32_t>(i), stretch_index});
    }
  }
}

}  // namespace beaconless
