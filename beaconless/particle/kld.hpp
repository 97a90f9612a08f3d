// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

namespace beaconless {

/// How many samples it takes so that, with the confidence that the quantile `z` stands for, the
/// Kullback-Leibler distance between them and what they are drawn from is at most `error`, where they lie in
/// `bins` bins.
///
/// A single bin takes one sample. Source: Fox, "Adapting the sample size in particle filters through
/// KLD-sampling", IJRR 2003, eq. (7), Wilson-Hilferty approximation; rounded up. Differs: ROS's amcl takes
/// the greatest count for a single bin, since it counts bins while it draws and would stop at the first.
inline std::size_t kld_sample_count(std::size_t bins, double error, double z) {
  if (bins < 2) return 1;
  const auto free = static_cast<double>(bins - 1);
  const double ninth = 2.0 / (9.0 * free);
  const double root = 1.0 - ninth + std::sqrt(ninth) * z;
  return static_cast<std::size_t>(std::ceil(free / (2.0 * error) * root * root * root));
}

}  // namespace beaconless
