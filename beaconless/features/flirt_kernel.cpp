// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_kernel.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace beaconless {
namespace {

constexpr double kReach_sigma = 3.0;  // where a Gaussian weighs 1 % of its middle

/// exp(-t) I_n(t), n = 0 … half, up to a factor: backwards from where it is nothing, since forwards the
/// recurrence I_{n-1} = I_{n+1} + (2 n / t) I_n drowns in rounding.
std::vector<double> bessel_weights(double t, std::size_t half) {
  const auto start = half + 20 + static_cast<std::size_t>(10.0 * std::sqrt(t) + t / 10.0);
  std::vector<double> weights(half + 1, 0.0);
  double above = 0.0;
  double here = 1e-300;
  for (std::size_t n = start; n > 0; --n) {
    double below = above + 2.0 * static_cast<double>(n) / t * here;
    if (below > 1e200) {  // only ratios count
      const double shrink = 1e-200;
      for (double& weight : weights) weight *= shrink;
      here *= shrink;
      below *= shrink;
    }
    above = here;
    here = below;
    if (n - 1 <= half) weights[n - 1] = here;
  }
  return weights;
}

std::vector<double> gaussian_weights(double variance, std::size_t half) {
  std::vector<double> weights(half + 1);
  for (std::size_t n = 0; n <= half; ++n) weights[n] = std::exp(-0.5 * static_cast<double>(n * n) / variance);
  return weights;
}

}  // namespace

ScaleKernel make_scale_kernel(FlirtKernel kind, double sigma_beams) {
  ScaleKernel kernel;
  kernel.sigma = sigma_beams;
  kernel.variance = kind == FlirtKernel::flirtlib_bessel ? sigma_beams : sigma_beams * sigma_beams;
  const double reach = kind == FlirtKernel::flirtlib_bessel ? sigma_beams : kReach_sigma * sigma_beams;
  const auto half = static_cast<std::size_t>(std::max(1.0, std::ceil(reach)));
  const std::vector<double> weights = kind == FlirtKernel::sampled_gaussian
                                          ? gaussian_weights(kernel.variance, half)
                                          : bessel_weights(kernel.variance, half);
  double sum = weights[0];
  for (std::size_t n = 1; n <= half; ++n) sum += 2.0 * weights[n];
  kernel.weights.reserve(half + 1);
  for (const double weight : weights) kernel.weights.push_back(static_cast<float>(weight / sum));
  return kernel;
}

void smooth_signal(std::span<const float> signal, const ScaleKernel& kernel, std::vector<float>& padded,
                   std::span<float> smooth) {
  constexpr int kBlock = 16;  // samples at a time, held in registers while the taps pass
  const std::size_t half = kernel.half_width();
  const std::size_t size = signal.size();
  if (size == 0) return;

  // 1. The end values once more on both sides, and room for the last block.
  padded.resize(size + 2 * half + kBlock);
  std::fill_n(padded.begin(), half, signal.front());
  std::copy(signal.begin(), signal.end(), padded.begin() + static_cast<std::ptrdiff_t>(half));
  std::fill(padded.begin() + static_cast<std::ptrdiff_t>(half + size), padded.end(), signal.back());

  // 2. Blocks of samples, each summed from the middle outwards.
  using Block = Eigen::Array<float, kBlock, 1>;
  const auto block_at = [](const float* samples) { return Eigen::Map<const Block>(samples); };
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const float* middle = padded.data() + half + begin;
    Block sum = kernel.weights[0] * block_at(middle);
    for (std::size_t n = 1; n <= half; ++n)
      sum += kernel.weights[n] * (block_at(middle - n) + block_at(middle + n));
    std::copy_n(sum.data(), std::min<std::size_t>(kBlock, size - begin),
                smooth.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

}  // namespace beaconless
