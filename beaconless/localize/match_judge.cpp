// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/match_judge.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/localize/doubts.hpp"

namespace beaconless {
namespace {

/// How far a fit may be from the prediction: the larger of a distance and some of its standard deviations.
struct Tolerance {
  double sigmas = 0.0;
  double position_m = 0.0;
  double heading_rad = 0.0;
};
constexpr Tolerance kJump{3.0, 0.25, radians(8.0)};
constexpr Tolerance kSurprise{4.0, 0.06, radians(2.0)};
constexpr Tolerance kStart{0.0, 1.8, radians(60.0)};  // what a start pose may be off

bool is_further(const Pose2& map_from_laser, const Pose2& laser_from_base, const Prediction& prediction,
                const Tolerance& than) {
  const Pose2 correction = prediction.map_from_base.inverse() * map_from_laser * laser_from_base;
  const double slack_m = than.sigmas * std::sqrt(prediction.covariance.topLeftCorner<2, 2>().trace());
  const double slack_rad = than.sigmas * std::sqrt(prediction.covariance(2, 2));
  return std::hypot(correction.x_m, correction.y_m) > std::max(than.position_m, slack_m) ||
         std::abs(correction.theta_rad) > std::max(than.heading_rad, slack_rad);
}

}  // namespace

MatchJudge::MatchJudge(const LocalizerConfig& config, const SeenScan& seen)
    : config_(config.health),
      lost_stride_(config.search.lost_stride),
      seen_(&seen),
      laser_from_base_(config.base_from_laser.inverse()),
      health_(config.health) {}

void MatchJudge::begin() {
  health_ = Health(config_);
  is_first_ = true;
  lost_scans_ = 0;
}

bool MatchJudge::is_jump(const MatchResult& match, const Prediction& prediction) const {
  return is_further(match.map_from_laser, laser_from_base_, prediction, kJump);
}

bool MatchJudge::is_surprise(const MatchResult& match, const Prediction& prediction) const {
  return !is_first_ && is_further(match.map_from_laser, laser_from_base_, prediction, kSurprise);
}

bool MatchJudge::is_worth_searching(const MatchResult& match, const Prediction& prediction) {
  if (health_.lost() && health_.is_weak(match.on_map_ratio)) return lost_scans_++ % lost_stride_ == 0;
  lost_scans_ = 0;
  if (is_first_) return true;
  // A matcher that has too little to hold on to needs no other start where the prediction is right.
  if (!match.usable()) return health_.is_doubtful(seen_->fit_at(prediction).on_map_ratio);
  return health_.is_doubtful(match.on_map_ratio) || is_jump(match, prediction);
}

std::string_view MatchJudge::reason_to_coast(const MatchResult& match, const Prediction& prediction) const {
  if (seen_->is_covered()) return kCovered;
  if (!match.usable()) return seen_->matcher().too_few_pairs();
  if (!health_.at_home() && health_.is_weak(match.on_map_ratio))
    return is_first_ || !health_.lost() ? "the scan fits nowhere around the start pose"
                                        : "the scan fits nowhere around the last trusted pose";
  if (is_first_ && is_further(match.map_from_laser, laser_from_base_, prediction, kStart))
    return "the scan fits only far from the start pose";
  if (is_anywhere()) return {};
  if (is_jump(match, prediction)) return "the scan fits nowhere near the predicted pose";
  return {};
}

std::string_view MatchJudge::reason_against(const MatchResult& match, const Prediction& prediction) const {
  const std::string_view reason = reason_to_coast(match, prediction);
  return reason.empty() ? reason_against_features(match, prediction) : reason;
}

std::string_view MatchJudge::reason_against_features(const MatchResult& match,
                                                     const Prediction& prediction) const {
  if (seen_->matcher().judges_whole_scan() || is_anywhere()) return {};
  if (health_.is_weak(match.on_map_ratio)) return "the features fit, but too little of the rest of the scan";
  if (match.misfit > kClearlyBetter && match.misfit > seen_->fit_at(prediction).misfit + kClearlyBetter)
    return "the features fit, but the rest of the scan fits the predicted pose far better";
  return {};
}

}  // namespace beaconless
