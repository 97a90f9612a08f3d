// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "beaconless/match/match_result.hpp"
#include "beaconless/scan/scan.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// What makes one method of localization differ from another: what it takes from a scan, and how it fits that
/// to the map. Everything else (prediction, doubt, search, status) is TrackingLocalizer's.
class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;

  /// Takes from a scan what it needs. In: the scan and all points of it (laser frame), both of which stay
  /// until the next call; where the laser should be now (map_from_laser), and how sure that is.
  virtual void observe(const Scan& scan, std::span<const Eigen::Vector2d> points, const Pose2& expected,
                       const Eigen::Matrix3d& covariance) = 0;

  /// Fits that to the map from a guess; may be asked several times about one scan. Cost: nothing allocated
  /// once buffers have grown.
  virtual MatchResult match(const Pose2& guess) = 0;

  /// Whether `on_map_ratio` and `misfit` of its results tell about the whole scan.
  virtual bool judges_whole_scan() const { return false; }

  /// Whether its results tell a protection level.
  virtual bool tells_protection() const { return false; }

  /// Why a fit, good as it is, is not to be called ok; "" where nothing speaks against it. Static text.
  virtual std::string_view reservation(const MatchResult& /*taken*/) const { return {}; }

  /// Hears which of its fits was taken for the pose; nothing when none was.
  virtual void settle(const MatchResult& /*taken*/) {}

  /// Forgets what it remembers of earlier scans.
  virtual void forget() {}

  /// What it means when match() has too few pairs; static text.
  virtual std::string_view too_few_pairs() const = 0;
};

}  // namespace beaconless
