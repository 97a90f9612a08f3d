// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/other_starts.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/match/sidesteps.hpp"

namespace beaconless {
namespace {

constexpr double kBetter = 0.01;     // in misfit, before a start is preferred to one that was found first
constexpr int kThroughStride = 8;    // scans
constexpr double kLostWindow = 2.5;  // how much wider a lost robot searches
constexpr double kVague_m = 0.1;     // a prediction less certain than this is not gone by …
constexpr double kVague_rad = radians(5.0);  // … where the whole scan tells better

/// Whether the motion so far no longer tells where the robot is.
bool is_vague(const Prediction& prediction) {
  return prediction.covariance.topLeftCorner<2, 2>().trace() > kVague_m * kVague_m ||
         prediction.covariance(2, 2) > kVague_rad * kVague_rad;
}

}  // namespace

OtherStarts::OtherStarts(const LocalizerConfig& config, const SurfaceMap& map, SeenScan& seen,
                         MatchJudge& judge, Rivals& rivals)
    : config_(config.search),
      base_from_laser_(config.base_from_laser),
      nearness_(map, config.search.cell_m, config.search.truncate_m),
      seen_(&seen),
      judge_(&judge),
      rivals_(&rivals) {}

OtherStarts::Fits OtherStarts::fit(const MatchResult& first, const Prediction& prediction,
                                   bool is_through_walls) {
  Fits fits{first, std::nullopt};
  // 1. A fit that explains unusually little or is far off: from the best poses around the prediction, and
  //    where the method gets nowhere from any of them, by the whole scan.
  if (judge_->is_worth_searching(first, prediction)) {
    const std::span<const StartPose> starts = around(prediction);
    fits.best = fit_by_matcher(starts, first, prediction);
    if (judge_->is_first() || !judge_->reason_against(fits.best, prediction).empty())
      fits.whole_scan = fit_whole_scan(starts, prediction);
    return fits;
  }
  // 2. One through walls: it may lie on a wall's other face. Where that is not it, the building has changed,
  //    and every scan would be fitted in vain.
  through_scans_ = is_through_walls ? through_scans_ + 1 : 0;
  if (is_through_walls && first.usable() && through_scans_ % kThroughStride == 1) {
    fits.best = fit_by_matcher(beside(first), first, prediction);
    return fits;
  }
  // 3. None: by the whole scan, where the prediction tells little.
  if (!first.usable() && is_vague(prediction)) {
    const StartPose there{prediction.map_from_base * base_from_laser_};
    fits.whole_scan = fit_whole_scan({&there, 1}, prediction);
  }
  return fits;
}

std::span<const StartPose> OtherStarts::around(const Prediction& prediction) {
  LocalSearchConfig window = config_;
  if (judge_->health().lost()) {
    window.window_m *= kLostWindow;
    window.window_deg = 180.0;
  } else {
    const double slack_m =
        2.0 * std::sqrt(std::max(0.0, prediction.covariance.topLeftCorner<2, 2>().trace()));
    window.window_m = std::clamp(slack_m, window.window_m, kLostWindow * window.window_m);
  }
  search_around(seen_->points(), nearness_, prediction.map_from_base * base_from_laser_, window, scratch_,
                starts_);
  return starts_;
}

std::span<const StartPose> OtherStarts::beside(const MatchResult& match) {
  starts_.clear();
  for (const Pose2& pose : sidesteps(match.map_from_laser)) starts_.push_back({pose});
  return starts_;
}

template <class Fit>
MatchResult OtherStarts::best_of(std::span<const StartPose> starts, const MatchResult& first,
                                 const Prediction& prediction, const Fit& fit) {
  // While the robot is not lost, a place that it cannot have reached since the last scan is no answer,
  // however well the scan fits there.
  const bool anywhere = judge_->is_anywhere();
  MatchResult best = first;
  bool best_is_first = true;
  rivals_->note(first);
  if (!anywhere && judge_->is_jump(first, prediction)) best.misfit = 1.0;
  for (const StartPose& start : starts) {
    const MatchResult other = fit(start.map_from_laser);
    if (!other.usable() || (!anywhere && judge_->is_jump(other, prediction))) continue;
    rivals_->note(other);
    if (best.usable() && other.misfit > best.misfit - (best_is_first ? MatchJudge::kClearlyBetter : kBetter))
      continue;
    best = other;
    best_is_first = false;
  }
  return best;
}

MatchResult OtherStarts::fit_by_matcher(std::span<const StartPose> starts, const MatchResult& first,
                                        const Prediction& prediction) {
  return best_of(starts, first, prediction, [&](const Pose2& start) { return seen_->fit_from(start); });
}

std::optional<MatchResult> OtherStarts::fit_whole_scan(std::span<const StartPose> starts,
                                                       const Prediction& prediction) {
  if (seen_->matcher().judges_whole_scan() || seen_->is_covered()) return std::nullopt;
  const MatchResult best = best_of(starts, MatchResult{}, prediction,
                                   [&](const Pose2& start) { return seen_->fit_whole_from(start); });
  rivals_->forget_notes();  // those were fits of another kind than the method's
  if (!judge_->reason_to_coast(best, prediction).empty()) return std::nullopt;
  return best;
}

}  // namespace beaconless
