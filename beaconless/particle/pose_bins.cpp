// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/pose_bins.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "beaconless/particle/particles.hpp"

namespace beaconless {
namespace {

constexpr double kFarthest = 1e9;  // bins

}  // namespace

PoseBins::Key PoseBins::key_of(const Pose2& pose) {
  const auto bin_of = [](double value_m) {
    return static_cast<std::int32_t>(std::floor(std::clamp(value_m / kBin_m, -kFarthest, kFarthest)));
  };
  const double share = wrap_heading(pose.theta_rad) / (2.0 * kPi) + 0.5;
  return {bin_of(pose.x_m), bin_of(pose.y_m), std::min(static_cast<int>(share * kHeadings), kHeadings - 1)};
}

void PoseBins::clear(std::size_t poses) {
  table_.assign(std::max(table_.size(), std::bit_ceil(2 * poses + 2)), kNone);
  keys_.clear();
  keys_.reserve(poses);
}

int PoseBins::place(const Key& key, bool adds) {
  const std::size_t mask = table_.size() - 1;
  std::uint64_t hash = 0;
  for (const std::int32_t part : key) hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9E3779B97F4A7C15U;
  for (std::size_t at = (hash >> 32U) & mask;; at = (at + 1) & mask) {
    const int bin = table_[at];
    if (bin != kNone && keys_[static_cast<std::size_t>(bin)] == key) return bin;
    if (bin != kNone) continue;
    if (!adds) return kNone;
    table_[at] = static_cast<int>(keys_.size());
    keys_.push_back(key);
    return table_[at];
  }
}

}  // namespace beaconless
