// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/association.hpp"

#include <algorithm>

namespace beaconless::eval {
namespace {

/// The reference for the `repeat`-th (from 0) estimate of a stamp.
std::optional<Pose2> reference_at(const Trajectory& reference, Stamp stamp, std::ptrdiff_t repeat,
                                  double max_gap_s) {
  const auto earlier = [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; };
  const auto [first, last] =
      std::equal_range(reference.begin(), reference.end(), StampedPose{stamp, {}}, earlier);
  if (first == last) return reference.at(stamp, max_gap_s);
  return (first + std::min(repeat, last - first - 1))->pose;
}

}  // namespace

Association associate(const Trajectory& estimate, const Trajectory& reference, double max_gap_s) {
  Association association;
  std::ptrdiff_t repeat = 0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const auto& [stamp, pose] = estimate[i];
    repeat = i > 0 && estimate[i - 1].stamp == stamp ? repeat + 1 : 0;
    const auto partner = reference_at(reference, stamp, repeat, max_gap_s);
    if (partner && partner->is_finite() && pose.is_finite())
      association.pairs.push_back({stamp, pose, *partner});
    else
      ++association.unmatched_count;
  }
  return association;
}

}  // namespace beaconless::eval
