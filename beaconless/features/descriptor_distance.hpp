// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace beaconless {

/// Symmetric chi-square distance of two histograms that each sum to 1: ½ Σ (p - q)² / (p + q), in [0, 1].
///
/// 0 for equal ones, 1 for those that share no bin; a bin empty in both adds nothing. Its square root obeys
/// the triangle inequality, it itself does not. Source: FLIRT's default; CGH's has the same form.
template <std::size_t N>
double symmetric_chi_square(const std::array<float, N>& a, const std::array<float, N>& b) {
  float sum = 0.0F;
  for (std::size_t k = 0; k < N; ++k) {
    const float difference = a[k] - b[k];
    sum += difference * difference / (a[k] + b[k] + 1e-30F);  // 0 / 0 is meant to be 0
  }
  return std::min(1.0, 0.5 * static_cast<double>(sum));
}

/// All distances between two lists of descriptors: row i, column j is distance(first[i], second[j]), row
/// after row, each in [0, 1].
template <class Descriptor>
void descriptor_distances(std::span<const Descriptor> first, std::span<const Descriptor> second,
                          std::vector<float>& out) {
  out.clear();
  out.reserve(first.size() * second.size());
  for (const Descriptor& a : first)
    for (const Descriptor& b : second) out.push_back(static_cast<float>(distance(a, b)));
}

template <class Descriptor>
std::vector<float> descriptor_distances(const std::vector<Descriptor>& first,
                                        const std::vector<Descriptor>& second) {
  std::vector<float> out;
  descriptor_distances(std::span<const Descriptor>(first), std::span<const Descriptor>(second), out);
  return out;
}

}  // namespace beaconless
