// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "beaconless/localize/match_judge.hpp"
#include "beaconless/localize/rivals.hpp"
#include "beaconless/localize/seen_scan.hpp"
#include "beaconless/map/nearness_pyramid.hpp"
#include "beaconless/match/local_search.hpp"

namespace beaconless {

/// Fits the scan at hand from other starts where the fit from the prediction is hard to believe.
///
/// A robot that turns by 20° between two scans is outside the basin of any of the matchers, but in the window
/// that search_around() searches. Where a matcher of features gets nowhere from there either, the whole scan
/// tells. Cost: nothing where the first fit is good; else a search of the window and a fit from each of its
/// best poses. Allocates nothing once buffers have grown.
class OtherStarts {
 public:
  /// `seen`, `judge` and `rivals`, which notes the fits, are shared with who follows the robot, and outlive
  /// this.
  OtherStarts(const LocalizerConfig& config, const SurfaceMap& map, SeenScan& seen, MatchJudge& judge,
              Rivals& rivals);

  /// What came of a scan.
  struct Fits {
    MatchResult best;                       ///< the matcher's
    std::optional<MatchResult> whole_scan;  ///< that of the whole scan, where that had to tell
  };

  /// In: the fit from the prediction; whether beams passed through walls where the robot was thought to be.
  Fits fit(const MatchResult& first, const Prediction& prediction, bool is_through_walls);

 private:
  std::span<const StartPose> around(const Prediction& prediction);
  std::span<const StartPose> beside(const MatchResult& match);
  template <class Fit>
  MatchResult best_of(std::span<const StartPose> starts, const MatchResult& first,
                      const Prediction& prediction, const Fit& fit);
  MatchResult fit_by_matcher(std::span<const StartPose> starts, const MatchResult& first,
                             const Prediction& prediction);
  std::optional<MatchResult> fit_whole_scan(std::span<const StartPose> starts, const Prediction& prediction);

  LocalSearchConfig config_;
  Pose2 base_from_laser_;
  NearnessPyramid nearness_;
  SeenScan* seen_;
  MatchJudge* judge_;
  Rivals* rivals_;
  LocalSearchScratch scratch_;
  std::vector<StartPose> starts_;
  int through_scans_ = 0;  // in a row
};

}  // namespace beaconless
