// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/walls_matcher.hpp"

#include <cmath>
#include <utility>

namespace beaconless {
namespace {

constexpr double kPrior_sigma = 3.0;
constexpr double kRough_m = 0.1;       // a guess less certain than this is brought near by ICP first
constexpr double kTypicalArm_m = 3.0;  // at which the heading's uncertainty counts

}  // namespace

WallsMatcher::WallsMatcher(std::shared_ptr<const WallIndex> walls, const WallsConfig& config,
                           const IcpConfig& coarse)
    : walls_(std::move(walls)), config_(config), coarse_(coarse) {}

void WallsMatcher::observe(const Scan& /*scan*/, std::span<const Eigen::Vector2d> points,
                           const Pose2& expected, const Eigen::Matrix3d& covariance) {
  points_ = points;
  expected_ = expected;
  prior_m_ = kPrior_sigma * std::sqrt(covariance.topLeftCorner<2, 2>().trace() +
                                      kTypicalArm_m * kTypicalArm_m * covariance(2, 2));
}

MatchResult WallsMatcher::match(const Pose2& guess) {
  const bool is_expected = guess == expected_;
  if (is_expected && prior_m_ < kRough_m)
    return match_walls(points_, *walls_, guess, prior_m_, config_, scratch_);
  MatchResult near = match_icp(points_, *walls_, guess, coarse_, coarse_scratch_);
  if (!near.usable()) return near;
  return match_walls(points_, *walls_, near.map_from_laser, kRough_m, config_, scratch_);
}

}  // namespace beaconless
