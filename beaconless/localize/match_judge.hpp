// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "beaconless/localize/health.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/localize/seen_scan.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// Judges whether a fit of the scan at hand is to be believed: by how far it is from where the robot should
/// be, and by how much of the scan it explains against what is usual.
///
/// Reasons are static text, "" where nothing speaks against the fit. Cost: none, or that of SeenScan::fit_at.
class MatchJudge {
 public:
  /// `seen` outlives this.
  MatchJudge(const LocalizerConfig& config, const SeenScan& seen);

  /// The robot was put somewhere: the next scan is the first from there.
  void begin();
  void end_scan() { is_first_ = false; }

  Health& health() { return health_; }
  const Health& health() const { return health_; }
  bool is_first() const { return is_first_; }

  /// Whether the prediction says little of where the robot is.
  bool is_anywhere() const { return is_first_ || health_.lost(); }

  /// Whether the robot can hardly have got there since the last scan.
  bool is_jump(const MatchResult& match, const Prediction& prediction) const;

  /// Whether no motion explains it: such a pose is announced, and others must agree before it is called ok.
  bool is_surprise(const MatchResult& match, const Prediction& prediction) const;

  /// Whether other starts are worth their time. Is asked once a scan.
  bool is_worth_searching(const MatchResult& match, const Prediction& prediction);

  /// Why the pose is not to be taken from a fit of the whole scan …
  std::string_view reason_to_coast(const MatchResult& match, const Prediction& prediction) const;
  /// … and from one by the matcher.
  std::string_view reason_against(const MatchResult& match, const Prediction& prediction) const;

  static constexpr double kClearlyBetter = 0.05;  ///< in misfit, before another fit is preferred

 private:
  std::string_view reason_against_features(const MatchResult& match, const Prediction& prediction) const;

  HealthConfig config_;
  int lost_stride_;
  const SeenScan* seen_;
  Pose2 laser_from_base_;
  Health health_;
  bool is_first_ = true;
  int lost_scans_ = 0;
};

}  // namespace beaconless
