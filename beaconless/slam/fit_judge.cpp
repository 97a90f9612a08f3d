// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/fit_judge.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

constexpr double kFarPenalty = 0.1;  // in score, of a fit as far as any robot gets
constexpr double kFollow = 0.1;      // how fast what is usual follows the scans

bool is_near(const Pose2& correction, const SlamReach& reach) {
  return std::hypot(correction.x_m, correction.y_m) <= reach.near_m &&
         degrees(std::abs(correction.theta_rad)) <= reach.near_deg;
}

}  // namespace

void describe(Fields& fields, FitJudgeConfig& config) {
  fields("doubt_share", config.doubt_share, {0.0, 1.0},
         "a fit that explains less of the scan than this share of what is usual is in doubt");
  fields("least_overlap", config.least_overlap, {0.0, 1.0},
         "share of a scan that must lie on known walls to be held by them");
  fields("least_explained", config.least_explained, {0.0, 1.0},
         "of what falls on known ground, the share that must lie on walls");
}

bool FitJudge::contradicts(const SlamFit& fit) const {
  return fit.overlap.explained_ratio() <
         std::max(config_.least_explained, config_.doubt_share * usual_explained_ratio_);
}

bool FitJudge::is_in_doubt(const SlamFit& fit) const {
  return !fit.match.usable() || contradicts(fit) ||
         fit.overlap.on_ratio < config_.doubt_share * usual_on_ratio_;
}

bool FitJudge::is_surprising(const SlamFit& fit, const Pose2& correction, const SlamReach& reach) const {
  return is_in_doubt(fit) && !is_near(correction, reach);
}

double FitJudge::worth(const SlamFit& fit, const Pose2& correction, const SlamReach& reach) const {
  const double move_m = std::hypot(correction.x_m, correction.y_m);
  const double turn_deg = degrees(std::abs(correction.theta_rad));
  const double far = std::max(move_m / reach.far_m, turn_deg / reach.far_deg);
  if (!fit.match.usable() || (far > 1.0 && is_in_doubt(fit)) ||
      (!is_near(correction, reach) && contradicts(fit)))
    return kWorthless;
  return fit.overlap.score() - kFarPenalty * std::min(1.0, far * far);
}

std::string_view FitJudge::reason_not_held(const SlamFit& fit, double worth) const {
  if (!fit.match.usable() || fit.overlap.on_ratio < config_.least_overlap)
    return "hardly any of the scan lies on what is known of the map";
  if (fit.overlap.explained_ratio() < config_.least_explained) return "the scan contradicts the map";
  if (worth == kWorthless) return "the scan fits nowhere near the predicted pose";
  return {};
}

void FitJudge::learn(const SlamFit& fit) {
  usual_explained_ratio_ += kFollow * (fit.overlap.explained_ratio() - usual_explained_ratio_);
  usual_on_ratio_ += kFollow * (fit.overlap.on_ratio - usual_on_ratio_);
}

}  // namespace beaconless
