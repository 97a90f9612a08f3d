// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/feature_matcher.hpp"

#include <utility>

namespace beaconless {

FeatureMatcher::FeatureMatcher(const FeatureMatcherConfig& config, FeatureMap map)
    : config_(config), map_(std::move(map)), tracker_(config.tracking.value_or(FeatureTrackerConfig{})) {}

void FeatureMatcher::observe(const Scan& scan, const Pose2& expected, const Eigen::Matrix3d& covariance) {
  find_point_features(scan, config_.detector, config_.detecting, detecting_, features_);
  seen_count_ = features_.size();
  if (config_.tracking) tracker_.recall(expected, covariance, features_);
}

MatchResult FeatureMatcher::match(const Pose2& guess) {
  return match_feature_icp(features_, map_, guess, config_.icp, matching_);
}

void FeatureMatcher::settle(const MatchResult& taken) {
  if (!config_.tracking) return;
  // Only what was seen is new, and only what the map knows is worth remembering.
  for (std::size_t i = 0; i < seen_count_; ++i) {
    bool is_mapped = false;
    map_.places.for_each_within(taken.map_from_laser * features_[i].point, config_.mapped_m,
                                [&](std::size_t /*feature*/) { is_mapped = true; });
    if (is_mapped) tracker_.remember({&features_[i], 1}, taken.map_from_laser);
  }
}

}  // namespace beaconless
