// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/relocalizer.hpp"

#include <cmath>
#include <utility>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/localize/doubts.hpp"
#include "beaconless/localize/same_place.hpp"

namespace beaconless {
namespace {

constexpr int kFewAgree = 3;      // scans of a slow scanner that agree on a place suffice …
constexpr double kAgree_s = 0.6;  // … over so long
constexpr double kFastest_m_per_s = 3.0;

constexpr std::string_view kSeveral = "several places of the map fit what was seen; a drive tells which";
constexpr std::string_view kOpenPlace =
    "the place that fits leaves a direction open, or others are not far behind; a drive tells more";

}  // namespace

void Relocalizer::begin(const FloorPlan::Bounds& box, int agreeing_scans, PlaceFinder::Wanted wanted) {
  agreeing_scans_ = agreeing_scans;
  agreed_scans_ = 0;
  candidates_.clear();
  finder_->begin(box, std::move(wanted));
}

std::optional<PoseEstimate> Relocalizer::see(Stamp stamp, std::span<const Eigen::Vector2d> points,
                                             const std::optional<Pose2>& moved, const Pose2& believed) {
  // 1. Where the scan fits.
  const PlaceFinder::Verdict verdict = finder_->see(stamp, points, moved);
  candidates_.clear();
  for (const PlaceFinder::Place& place : finder_->likely())
    candidates_.push_back({base_at(place), place.now.on_map, finder_->weight(place)});
  if (verdict == PlaceFinder::Verdict::nothing)
    return nowhere(stamp, believed, "the scan fits nowhere where it was looked for");
  // 2. It is there, once enough scans agree on one place.
  if (verdict != PlaceFinder::Verdict::one || !agrees(stamp)) agreed_scans_ = 0;
  if (verdict == PlaceFinder::Verdict::one) {
    if (agreed_scans_++ == 0) agreed_since_ = stamp;
    agreed_last_ = stamp;
    agreed_on_ = finder_->places().front().map_from_laser;
  }
  const bool is_long = agreed_scans_ >= kFewAgree && seconds_between(agreed_since_, stamp) >= kAgree_s;
  if (agreed_scans_ < agreeing_scans_ && !is_long) return searching(stamp, verdict);
  return std::nullopt;
}

/// Whether a robot can have gone from the place of the scan before to that of this one: where none fits for
/// a scan all are looked for anew.
bool Relocalizer::agrees(Stamp stamp) const {
  const double way_m = distance_m(agreed_on_, finder_->places().front().map_from_laser);
  return way_m < kSamePlace_m + kFastest_m_per_s * std::abs(seconds_between(agreed_last_, stamp));
}

PoseEstimate Relocalizer::nowhere(Stamp stamp, const Pose2& believed, std::string_view reason) {
  candidates_.clear();
  agreed_scans_ = 0;
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_from_base = believed;
  estimate.status = Status::lost;
  estimate.reason = reason;
  return estimate;
}

/// The likeliest place, and in the covariance that it may be another.
PoseEstimate Relocalizer::searching(Stamp stamp, PlaceFinder::Verdict verdict) const {
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.status = Status::relocalizing;
  estimate.reason = verdict == PlaceFinder::Verdict::one ? kFound
                    : candidates_.size() > 1             ? kSeveral
                                                         : kOpenPlace;
  const PlaceFinder::Place& best = finder_->places().front();
  estimate.map_from_base = candidates_.front().map_from_base;
  estimate.covariance =
      moved_covariance(best.covariance, best.map_from_laser, laser_from_base_) + kLostCovariance;
  for (const PoseCandidate& candidate : candidates_) {
    const Eigen::Vector3d way = way_between(estimate.map_from_base, candidate.map_from_base);
    estimate.covariance += candidate.weight * way * way.transpose();
  }
  estimate.covariance = symmetric(estimate.covariance);
  return estimate;
}

bool Relocalizer::is_only_at(const Pose2& map_from_base, Stamp stamp,
                             std::span<const Eigen::Vector2d> points) {
  finder_->begin();
  if (finder_->see(stamp, points, std::nullopt) != PlaceFinder::Verdict::one) return false;
  const Pose2 here = map_from_base * laser_from_base_.inverse();
  return is_same_place(here, finder_->places().front().map_from_laser);
}

}  // namespace beaconless
