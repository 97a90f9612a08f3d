// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/pairs_by_chance.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

/// The area that features of a set are found in; a set on one line is as wide as one place.
double area_m2(const FeatureSet& set, double place_m) {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  bool any = false;
  for (const Eigen::Vector2d& point : set.points) {
    if (!point.allFinite()) continue;
    low = any ? low.cwiseMin(point).eval() : point;
    high = any ? high.cwiseMax(point).eval() : point;
    any = true;
  }
  const Eigen::Vector2d size = (high - low).cwiseMax(place_m);
  return size.x() * size.y();
}

}  // namespace

double pairs_by_chance(const FeatureSet& first, const FeatureSet& second, std::size_t candidate_count,
                       std::size_t pair_count, const PairingConfig& config) {
  const std::size_t features = std::min(first.points.size(), second.points.size());
  const auto candidates = static_cast<double>(candidate_count);
  const double chance = 0.5 * candidates * candidates;
  if (features < 2 || pair_count < 2) return chance;

  // 1. The chance of one feature to have a partner at a pose that is wrong.
  const double place_m2 = kPi * config.same_place_m2();
  double area = area_m2(second, 2.0 * std::sqrt(config.same_place_m2()));
  if (config.gate_m > 0.0) area = std::min(area, kPi * config.gate_m * config.gate_m);
  double one = candidates / static_cast<double>(features) * std::min(1.0, place_m2 / area);
  if (!first.orientations_rad.empty() && !second.orientations_rad.empty())
    one *= std::min(1.0, config.turn_tolerance_rad / kPi);
  one = std::min(one, 1.0);

  // 2. Of (n over m) choices of m features each may have all its partners.
  const std::size_t others = features - 2;
  const std::size_t more = std::min(pair_count - 2, others);
  double tail = 1.0;
  for (std::size_t k = 0; k < more; ++k)
    tail *= static_cast<double>(others - k) / static_cast<double>(k + 1) * one;
  return chance * std::min(tail, 1.0);
}

}  // namespace beaconless
