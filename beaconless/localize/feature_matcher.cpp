// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/feature_matcher.hpp"

#include <utility>

namespace beaconless {
namespace {

constexpr double kMapped_m = 0.10;  // a feature of the scan this near to one of the map is that one

}  // namespace

FeatureMatcher::FeatureMatcher(const FeatureMatcherConfig& config, FeatureMap map)
    : config_(config), map_(std::move(map)), tracker_(config.tracking.value_or(FeatureTrackerConfig{})) {}

void FeatureMatcher::observe(const Scan& scan, std::span<const Eigen::Vector2d> /*points*/,
                             const Pose2& expected, const Eigen::Matrix3d& covariance) {
  find_point_features(scan, config_.detector, config_.detecting, detecting_, features_);
  seen_count_ = features_.size();
  if (config_.tracking) tracker_.recall(expected, covariance, features_);
}

MatchResult FeatureMatcher::match(const Pose2& guess) {
  return match_feature_icp(features_, map_, guess, config_.icp, matching_);
}

bool FeatureMatcher::is_mapped(const PointFeature& seen, const Pose2& map_from_laser) const {
  bool is_there = false;
  map_.places.for_each_within(map_from_laser * seen.point, kMapped_m,
                              [&](std::size_t /*feature*/) { is_there = true; });
  return is_there;
}

std::string_view FeatureMatcher::reservation(const MatchResult& taken) const {
  if (!config_.tracking) return {};
  int mapped = 0;
  for (std::size_t i = 0; i < seen_count_; ++i)
    mapped += is_mapped(features_[i], taken.map_from_laser) ? 1 : 0;
  return mapped < config_.icp.min_pairs
             ? "fewer than two features of the map are in view; the pose rests on remembered ones"
             : "";
}

void FeatureMatcher::settle(const MatchResult& taken) {
  if (!config_.tracking) return;
  // Only what was seen is new, and only what the map knows is worth remembering.
  for (std::size_t i = 0; i < seen_count_; ++i)
    if (is_mapped(features_[i], taken.map_from_laser))
      tracker_.remember({&features_[i], 1}, taken.map_from_laser);
}

}  // namespace beaconless
