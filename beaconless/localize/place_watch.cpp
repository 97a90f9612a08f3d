// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/place_watch.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/localize/doubts.hpp"
#include "beaconless/localize/same_place.hpp"

namespace beaconless {
namespace {

constexpr double kEvery_s = 0.1;
constexpr double kLongest_s = 5.0;   // between looks that say nothing
constexpr double kPatience_s = 1.0;  // … of a robot that was followed
constexpr double kReach_m = 3.0;     // a robot that was followed has not gone further unseen
constexpr double kAround_m = 30.0;   // where is looked
constexpr int kAbsent = 3;           // looks, before a place is given up
constexpr double kDoubted = 0.45;    // most quality of a pose whose place is in doubt

constexpr std::string_view kLikeOthers = "another place of the map fits the scans about as well";
constexpr std::string_view kElsewhere = "the scans fit another place of the map far better";

}  // namespace

void doubt(PoseEstimate& estimate, PlaceWatch::Finding finding) {
  if (finding == PlaceWatch::Finding::beyond_doubt) return;
  // 1. What is in doubt is not to be relied on.
  estimate.quality = std::min(estimate.quality, kDoubted);
  estimate.protection_m = PoseEstimate::kUnbounded_m;
  estimate.protection_rad = kPi;
  // 2. What has its like in the map is degraded; what is elsewhere is lost.
  if (finding == PlaceWatch::Finding::rivalled && estimate.ok()) {
    estimate.status = Status::degraded;
    estimate.reason = kLikeOthers;
  }
  if (finding == PlaceWatch::Finding::elsewhere) {
    estimate.status = Status::lost;
    estimate.reason = kElsewhere;
    estimate.covariance += kLostCovariance;
  }
}

void PlaceWatch::forget() { in_doubt_ = false; }

void PlaceWatch::begin(double reach_m) {
  in_doubt_ = true;
  reach_m_ = reach_m;
  seen_.reset();
  was_.reset();
  finding_ = Finding::in_doubt;
  pause_s_ = kEvery_s;
  absent_ = 0;
}

void PlaceWatch::doubt_found(Stamp stamp, const Pose2& map_from_laser) {
  begin(std::numeric_limits<double>::infinity());
  seen_ = stamp;
  was_ = map_from_laser;
  finding_ = judge(map_from_laser, true);
  in_doubt_ = finding_ != Finding::beyond_doubt;
}

void PlaceWatch::doubt_followed(const Pose2& map_from_laser) {
  if (in_doubt_) return;
  finder_->begin_around(map_from_laser.translation(), kAround_m);
  begin(kReach_m);
}

PlaceWatch::Finding PlaceWatch::see(Stamp stamp, std::span<const Eigen::Vector2d> points,
                                    const Pose2& map_from_laser, bool is_fitted) {
  if (!in_doubt_) return Finding::beyond_doubt;
  if (seen_ && std::abs(seconds_between(*seen_, stamp)) < pause_s_) return finding_;
  // 1. Where else the scan fits, and how the places of before do.
  const auto moved = was_ ? std::optional(was_->inverse() * map_from_laser) : std::nullopt;
  finder_->propose(map_from_laser);
  const PlaceFinder::Verdict verdict = finder_->see(stamp, points, moved);
  seen_ = stamp;
  was_ = map_from_laser;
  // 2. What that says of the place.
  judge_or_wait(verdict, map_from_laser, is_fitted);
  return finding_;
}

/// A scan that fits nowhere says nothing, and the next ones will hardly say more: looks become rare, and a
/// robot that was followed is believed.
void PlaceWatch::judge_or_wait(PlaceFinder::Verdict verdict, const Pose2& map_from_laser, bool is_fitted) {
  if (verdict != PlaceFinder::Verdict::nothing) {
    pause_s_ = kEvery_s;
    finding_ = judge(map_from_laser, is_fitted);
  } else {
    pause_s_ = std::min(2.0 * pause_s_, kLongest_s);
    if (std::isfinite(reach_m_) && pause_s_ > kPatience_s) finding_ = Finding::beyond_doubt;
  }
  in_doubt_ = finding_ != Finding::beyond_doubt;
}

PlaceWatch::Finding PlaceWatch::judge(const Pose2& map_from_laser, bool is_fitted) {
  const auto is_here = [&](const PlaceFinder::Place& place) {
    return is_same_place(place.map_from_laser, map_from_laser);
  };
  const auto likely = finder_->likely();
  if (std::none_of(likely.begin(), likely.end(), is_here))
    return is_fitted && ++absent_ < kAbsent ? Finding::rivalled : Finding::elsewhere;
  absent_ = 0;
  const bool is_rivalled = std::any_of(likely.begin(), likely.end(), [&](const PlaceFinder::Place& place) {
    return !is_here(place) && distance_m(place.map_from_laser, map_from_laser) < reach_m_;
  });
  if (is_rivalled) return Finding::rivalled;
  const bool was_followed = std::isfinite(reach_m_);
  return was_followed || finder_->is_alone() ? Finding::beyond_doubt : Finding::in_doubt;
}

}  // namespace beaconless
