// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "beaconless/particle/particles.hpp"

namespace beaconless {

/// How many particles of equal weight would be as good: 1 / the sum of squared weights.
inline double effective_count(std::span<const double> weights);

/// Calls `visit(i, times)` for every index that a comb of `count` even teeth touches, the first at `offset`
/// (0 … 1, of the way between two), where weights lie end to end: each is touched by the whole number of
/// times below or above its share. Source: Thrun et al., table 4.4 (low-variance sampler).
template <class Visit>
void comb_weights(std::span<const double> weights, std::size_t count, double offset, Visit&& visit) {
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  const double teeth = static_cast<double>(count) / sum;
  double reached = 0.0;
  std::size_t touched = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < weights.size() && touched < count; ++i) {
    reached += weights[i] * teeth;
    if (weights[i] > 0.0) last = i;
    std::size_t times = 0;
    while (touched + times < count && static_cast<double>(touched + times) + offset < reached) ++times;
    if (times > 0) visit(i, times);
    touched += times;
  }
  if (touched < count) visit(last, count - touched);  // rounding kept a tooth back
}

/// Draws `count` particles of weight 1 / `count` by one comb and adds them to `drawn`. Cost: linear.
inline void draw_low_variance(const Particles& from, std::size_t count, double offset, Particles& drawn) {
  comb_weights(from.weight, count, offset, [&](std::size_t i, std::size_t times) {
    for (std::size_t n = 0; n < times; ++n) drawn.add(from.pose(i), 1.0 / static_cast<double>(count));
  });
}

inline double effective_count(std::span<const double> weights) {
  double squares = 0.0;
  double sum = 0.0;
  for (const double weight : weights) {
    squares += weight * weight;
    sum += weight;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

}  // namespace beaconless
