// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "beaconless/features/point_feature.hpp"
#include "beaconless/localize/scan_matcher.hpp"
#include "beaconless/match/feature_icp.hpp"
#include "beaconless/track/feature_tracker.hpp"

namespace beaconless {

/// Where feature methods get their parameters from.
struct FeatureMatcherConfig {
  Detector detector = Detector::corners;
  PointFeaturesConfig detecting;
  FeatureIcpConfig icp;
  std::optional<FeatureTrackerConfig> tracking;  ///< nothing: only what is seen counts
};

/// Fits features of a scan to those of the map: what is seen now, and what was seen a moment ago.
class FeatureMatcher final : public ScanMatcher {
 public:
  FeatureMatcher(const FeatureMatcherConfig& config, FeatureMap map);

  void observe(const Scan& scan, std::span<const Eigen::Vector2d> points, const Pose2& expected,
               const Eigen::Matrix3d& covariance) override;
  MatchResult match(const Pose2& guess) override;
  std::string_view reservation(const MatchResult& taken) const override;
  void settle(const MatchResult& taken) override;
  void forget() override { tracker_.forget(); }
  std::string_view too_few_pairs() const override {
    return "fewer than two features of the map are in view, which is too few for a pose";
  }

 private:
  bool is_mapped(const PointFeature& seen, const Pose2& map_from_laser) const;

  FeatureMatcherConfig config_;
  FeatureMap map_;
  FeatureTracker tracker_;
  PointFeaturesScratch detecting_;
  FeatureIcpScratch matching_;
  std::vector<PointFeature> features_;  // seen, then remembered
  std::size_t seen_count_ = 0;          // of them
};

}  // namespace beaconless
