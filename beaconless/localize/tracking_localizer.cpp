// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/tracking_localizer.hpp"

#include <cmath>
#include <utility>

#include "beaconless/localize/doubts.hpp"

namespace beaconless {

TrackingLocalizer::TrackingLocalizer(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map,
                                     std::unique_ptr<ScanMatcher> matcher)
    : config_(config),
      map_(std::move(map)),
      laser_from_base_(config.base_from_laser.inverse()),
      odometry_(config.odometry),
      seen_(config, map_, std::move(matcher)),
      sweep_(config, map_, seen_, odometry_),
      follower_(config, map_, seen_, sweep_, odometry_),
      finder_(config.places, map_, config.icp, config.walls),
      relocalizer_(finder_, laser_from_base_),
      search_motion_(config.base_from_laser),
      watch_(finder_) {}

void TrackingLocalizer::start_at(const Pose2& map_from_base) {
  if (!map_from_base.is_finite()) return;
  follower_.start_at(map_from_base);
  relocalizer_.forget();
  watch_.forget();
  way_.begin();
  last_ = PoseEstimate{};
  last_.map_from_base = map_from_base;
  last_scan_.reset();
  started_ = true;
  is_anywhere_ = false;
}

void TrackingLocalizer::start_anywhere(const std::optional<SearchRegion>& within) {
  FloorPlan::Bounds box = bounds_of(*map_);
  PlaceFinder::Wanted wanted;
  if (within && within->middle.allFinite() && std::isfinite(within->radius_m)) {
    const double reach_m = within->radius_m + config_.base_from_laser.translation().norm();
    box.low = box.low.cwiseMax((within->middle.array() - reach_m).matrix());
    box.high = box.high.cwiseMin((within->middle.array() + reach_m).matrix());
    wanted = [region = *within, laser_from_base = laser_from_base_](const Pose2& map_from_laser) {
      const Pose2 map_from_base = map_from_laser * laser_from_base;
      return (map_from_base.translation() - region.middle).norm() <= region.radius_m;
    };
  }
  last_ = PoseEstimate{};
  last_scan_.reset();
  was_placed_ = false;
  search_anywhere(box, 1, std::move(wanted));
}

void TrackingLocalizer::search_anywhere(const FloorPlan::Bounds& box, int agreeing_scans,
                                        PlaceFinder::Wanted wanted) {
  is_anywhere_ = true;
  search_motion_.begin();
  relocalizer_.begin(box, agreeing_scans, std::move(wanted));
}

PoseEstimate TrackingLocalizer::update(const Event& event) {
  const Scan* scan = std::get_if<Scan>(&event);
  if (const auto* odometry = std::get_if<Odometry>(&event))
    odometry_.add(odometry->stamp, odometry->odom_from_base);
  if (scan == nullptr || !(started_ || is_anywhere_)) return without_scan(event);
  // 1. A robot that may be anywhere is looked for, and followed from where it is found.
  const bool was_anywhere = is_anywhere_;
  if (is_anywhere_) {
    if (const auto estimate = find(*scan)) return last_ = *estimate;
  }
  // 2. One that is somewhere is followed; found elsewhere than where it was thought to be, it has jumped.
  last_ = follower_.follow(*scan);
  last_scan_ = scan->stamp();
  last_.jumped = last_.jumped || (was_anywhere && was_placed_);
  was_placed_ = was_placed_ || last_.ok();
  // 3. Where that place is in doubt, it is held against all others.
  hold_against_others(*scan);
  // 4. One that is no longer there may be anywhere.
  if (is_gone(*scan)) search_anywhere(bounds_of(*map_), config_.health.found_after_scans);
  return last_;
}

PoseEstimate TrackingLocalizer::without_scan(const Event& event) const {
  PoseEstimate estimate = last_;
  estimate.stamp = stamp_of(event);
  const bool is_known = started_ || is_anywhere_;
  estimate.status = is_known ? Status::not_a_scan : Status::not_started;
  estimate.reason = is_known ? "the event brought no scan" : "no start pose was given";
  return estimate;
}

std::optional<PoseEstimate> TrackingLocalizer::find(const Scan& scan) {
  // 1. How the robot moves, and what the laser saw. What was seen before that was known is seen anew, if it
  //    makes a difference.
  const std::optional<Stamp> before = last_scan_;
  const double since_s = before ? seconds_between(*before, scan.stamp()) : 0.0;
  const bool is_news =
      search_motion_.expect(before ? odometry_.between(*before, scan.stamp()) : std::nullopt);
  if (is_news && sweep_.is_bent_by(search_motion_.motion(), scan)) finder_.begin_again();
  seen_.see(scan, search_motion_.motion(), last_.map_from_base * config_.base_from_laser, kLostCovariance);
  // 2. What that tells of where it is.
  if (seen_.is_covered()) return relocalizer_.nowhere(scan.stamp(), last_.map_from_base, kCovered);
  last_scan_ = scan.stamp();
  auto estimate = relocalizer_.see(scan.stamp(), seen_.points(),
                                   before ? search_motion_.way(since_s) : std::nullopt, last_.map_from_base);
  if (before) search_motion_.hear(finder_.moved(), since_s);
  if (estimate) return estimate;
  // 3. It is there.
  const Pose2 found = relocalizer_.found();
  start_at(found);
  watch_.doubt_found(scan.stamp(), found * config_.base_from_laser);
  return std::nullopt;
}

void TrackingLocalizer::hold_against_others(const Scan& scan) {
  const Pose2 map_from_laser = last_.map_from_base * config_.base_from_laser;
  Shaken& shaken = follower_.shaken();
  const bool can_tell =
      !shaken.is_blinded() && !seen_.is_covered() && !follower_.has_rivals() && last_.status != Status::lost;
  // 1. Whether there is any doubt.
  if (can_tell && config_.relocalize && shaken.take(scan.stamp(), follower_.is_through_walls()))
    watch_.doubt_followed(map_from_laser);
  if (!watch_.is_in_doubt()) return;
  // 2. What else fits, and what that leaves of the pose.
  const PlaceWatch::Finding finding =
      can_tell ? watch_.see(scan.stamp(), seen_.points(), map_from_laser, shaken.is_fitted())
               : watch_.finding();
  doubt(last_, finding);
  // 3. One that is elsewhere may be anywhere.
  if (finding == PlaceWatch::Finding::elsewhere && config_.relocalize)
    search_anywhere(bounds_of(*map_), config_.health.found_after_scans);
}

/// Lost, or where the wheels say that it cannot be, unless that is the only place that fits.
bool TrackingLocalizer::is_gone(const Scan& scan) {
  const bool has_parted = way_.part(scan.stamp(), last_.map_from_base, odometry_);
  if (!config_.relocalize || is_anywhere_) return false;
  if (follower_.is_adrift()) return true;
  return has_parted && !watch_.is_in_doubt() &&
         !relocalizer_.is_only_at(last_.map_from_base, scan.stamp(), seen_.points());
}

}  // namespace beaconless
