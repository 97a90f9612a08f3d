// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/match_result.hpp"
#include "beaconless/slam/overlap.hpp"

namespace beaconless {

/// A pose for a scan, and what the map says of it.
struct SlamFit {
  MatchResult match;
  Overlap overlap;
};

/// How far a fit may be from where the motion so far leads.
struct SlamReach {
  double far_m = 0.6;  ///< no robot gets further in the time
  double far_deg = 30.0;
  double near_m = 0.25;  ///< … and nobody wonders about this
  double near_deg = 10.0;
};

/// When a fit is believed in a map that is not finished.
struct FitJudgeConfig {
  double doubt_share = 0.9;       ///< a fit that explains less than this share of what is usual is in doubt
  double least_overlap = 0.15;    ///< the share of a scan that must lie on known walls to be held by them
  double least_explained = 0.65;  ///< of what falls on known ground, the share that must lie on walls
};

void describe(Fields& fields, FitJudgeConfig& config);

/// Judges fits by what they explain of the scan, against what is usual, and by how far they are from the
/// prediction.
///
/// A wrong pose makes beams end where the map is free, or behind walls where nothing is known. New ground
/// does the second too, people and moved things the first: so nothing absolute tells a wrong pose, but a
/// drop against the scans before, together with a jump, does. What is usual is learnt from fits that were
/// taken.
class FitJudge {
 public:
  explicit FitJudge(const FitJudgeConfig& config) : config_(config) {}

  /// True where poses around should be tried too.
  bool is_in_doubt(const SlamFit& fit) const;

  /// True where more of the scan than usual lies where the map is free.
  bool contradicts(const SlamFit& fit) const;

  /// True where a fit in doubt is not near the prediction either.
  bool is_surprising(const SlamFit& fit, const Pose2& correction, const SlamReach& reach) const;

  /// What a fit is worth beside others of the same scan; kWorthless for one out of reach that is in doubt, or
  /// not near and contradicting the map. In: the way from the prediction to the fit.
  double worth(const SlamFit& fit, const Pose2& correction, const SlamReach& reach) const;

  /// Why the robot should rather go on by its motion than take this fit; "" when it should take it. Static
  /// text.
  std::string_view reason_not_held(const SlamFit& fit, double worth) const;

  /// A fit was taken.
  void learn(const SlamFit& fit);

  static constexpr double kWorthless = -2.0;

 private:
  FitJudgeConfig config_;
  double usual_on_ratio_ = 1.0;
  double usual_explained_ratio_ = 1.0;
};

}  // namespace beaconless
