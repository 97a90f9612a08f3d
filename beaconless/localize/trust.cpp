// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/trust.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/match/see_through.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kFirstBeams = 120;
constexpr double kMemory = 8.0;           // scans that speak
constexpr double kLeastExplained = 0.05;  // share of the scan of which a blur can be told

// What speaks against a pose, in units of doubt, and how much doubt is too much.
constexpr double kOfThrough = 20.0;
constexpr double kOfBlur = 3.0;
constexpr double kOfLevel = 3.0;  // of a level of this and more:
constexpr double kLoose_m = 0.6;
constexpr double kUntold = 0.5;  // of a method that tells no level
constexpr double kTooMuch = 1.2;
constexpr double kSteep = 4.0;

}  // namespace

void Trust::begin() { seen_ = 0; }

void Trust::see(std::span<const Eigen::Vector2d> points, const SurfaceMap& map, const MatchResult& match,
                double slack_m) {
  // 1. Other beams than the last time.
  const std::size_t beams = seen_ == 0 ? kFirstBeams : kBeams;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / beams);
  const double through =
      see_through_share(points, map, match.map_from_laser, stride, slack_m, seen_ % stride);
  const double off = match.misfit - (1.0 - match.on_map_ratio);
  const double blur = off / std::max(match.on_map_ratio, kLeastExplained);
  // 2. What they say, beside what was said of late.
  const double follow = seen_ == 0 ? 1.0 : 1.0 / kMemory;
  through_ += follow * (through - through_);
  blur_ += follow * (blur - blur_);
  ++seen_;
}

double Trust::quality(std::optional<double> protection_m) const {
  const double loose = protection_m ? kOfLevel * std::min(1.0, *protection_m / kLoose_m) : kUntold;
  const double doubt = kOfThrough * through_ + kOfBlur * blur_ + loose;
  return 1.0 / (1.0 + std::exp(kSteep * (doubt - kTooMuch)));
}

}  // namespace beaconless
