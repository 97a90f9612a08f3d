// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/trust.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless::eval {
namespace {

constexpr std::size_t kBins = 10;

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double Trust::false_ok_ratio() const { return ratio(false_ok_count, trusted_count); }
double Trust::violation_ratio() const { return ratio(violation_count, bounded_count); }

std::vector<JudgedEstimate> judge_estimates(std::span<const PoseEstimate> estimates, const Trajectory& truth,
                                            double max_gap_s) {
  std::vector<JudgedEstimate> judged;
  for (const PoseEstimate& estimate : estimates) {
    const bool tells_a_pose = estimate.status == Status::ok || estimate.status == Status::degraded ||
                              estimate.status == Status::lost;
    const auto at = tells_a_pose ? truth.at(estimate.stamp, max_gap_s) : std::nullopt;
    if (!at) continue;
    judged.push_back(
        {.stamp = estimate.stamp,
         .status = estimate.status,
         .quality = estimate.quality,
         .protection_m = estimate.protection_m,
         .protection_rad = estimate.protection_rad,
         .position_error_m = distance_m(estimate.map_from_base, *at),
         .heading_error_rad = std::abs(wrap_angle(estimate.map_from_base.theta_rad - at->theta_rad))});
  }
  return judged;
}

Trust trust_of(std::span<const JudgedEstimate> estimates) {
  Trust trust;
  for (std::size_t i = 0; i < kBins; ++i)
    trust.bins.push_back({static_cast<double>(i) / kBins, static_cast<double>(i + 1) / kBins});
  for (const JudgedEstimate& e : estimates) {
    if (e.is_trusted()) {
      ++trust.trusted_count;
      if (!e.is_near()) ++trust.false_ok_count;
    }
    if (e.status != Status::lost && e.is_bounded()) {
      ++trust.bounded_count;
      if (e.is_beyond_protection()) ++trust.violation_count;
    }
    const auto bin = static_cast<std::size_t>(std::clamp(e.quality, 0.0, 1.0) * kBins);
    QualityBin& of = trust.bins[std::min(bin, kBins - 1)];
    ++of.count;
    if (e.is_near()) ++of.near_count;
  }
  return trust;
}

}  // namespace beaconless::eval
