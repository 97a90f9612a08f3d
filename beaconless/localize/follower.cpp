// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/follower.hpp"

#include <utility>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/localize/doubts.hpp"
#include "beaconless/localize/protect.hpp"

namespace beaconless {
namespace {

constexpr int kSurprised = 5;  // scans that must agree after a jump
constexpr double kThroughWalls_share = 0.2;
constexpr double kUncorrected = 0.4;  // most quality of a pose that no fit has corrected

constexpr std::string_view kRivalled = "another place nearby fits the scan nearly as well";
constexpr std::string_view kSurprising = "the pose has just jumped; more scans must agree";
constexpr std::string_view kThroughWalls = "many beams would have to pass through walls of the map";
constexpr std::string_view kOpenDirection =
    "the walls in view leave a direction open, which is held at the prediction";

}  // namespace

Follower::Follower(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map, SeenScan& seen,
                   SweepMotion& sweep, OdometryTrack& odometry)
    : map_(std::move(map)),
      seen_(&seen),
      sweep_(&sweep),
      odometry_(&odometry),
      base_from_laser_(config.base_from_laser),
      laser_from_base_(config.base_from_laser.inverse()),
      risk_(config.walls.protection.risk),
      map_sigma_m_(config.places.sigma_m),
      motion_(config.motion),
      judge_(config, seen),
      others_(config, *map_, seen, judge_, rivals_) {}

void Follower::start_at(const Pose2& map_from_base) {
  motion_.start_at(map_from_base);
  judge_.begin();
  seen_->matcher().forget();
  rivals_.clear();
  shaken_.forget();
  last_ = map_from_base;
  last_scan_.reset();
  explained_ = 0.0;
  surprised_scans_ = 0;
  is_through_walls_ = false;
}

PoseEstimate Follower::follow(const Scan& scan) {
  // 1. Where the robot should be by its motion so far.
  Prediction prediction = predict(scan);
  const Pose2 guess = prediction.map_from_base * base_from_laser_;
  // 2. What the laser saw.
  sweep_->begin();
  seen_->see(scan, prediction.motion, guess,
             moved_covariance(prediction.covariance, prediction.map_from_base, base_from_laser_));
  // 3. Fit it to the map from there; where that fit is hard to believe, from other starts too.
  rivals_.forget_notes();
  auto [match, whole_scan] = others_.fit(seen_->fit_from(guess), prediction, is_through_walls_);
  // 4. Where the fit tells another motion during the sweep, see the sweep by that.
  if (judge_.reason_against(match, prediction).empty())
    match = sweep_->refit(match, prediction, scan, motion_);
  // 5. Whether another place fits as well: looked for where the robot could be anywhere, then followed,
  //    and taken once it fits better.
  const bool is_anywhere = judge_.is_anywhere();
  bool is_other = false;
  if (is_anywhere)
    rivals_.look(match);
  else if (rivals_.any())
    is_other = rivals_.follow(match, (last_ * base_from_laser_).inverse() * match.map_from_laser,
                              [&](const Pose2& place) { return seen_->fit_from(place); });
  // 6. Whether beams would have to pass through walls there, which nothing in the way explains.
  if (is_anywhere) trust_.begin();
  trust_.see(seen_->points(), *map_, match, map_sigma_m_);
  is_through_walls_ = trust_.through() > kThroughWalls_share;
  // 7. Take the fit as the pose, or what the whole scan told, or go on by the motion alone.
  std::string_view doubt = is_other ? std::string_view{} : judge_.reason_against(match, prediction);
  if (doubt.empty() && whole_scan && whole_scan->misfit < match.misfit - MatchJudge::kClearlyBetter)
    doubt = "the whole scan fits another place far better";
  PoseEstimate estimate = doubt.empty() ? accept(match, prediction, scan, caveat_of(match, is_other))
                          : whole_scan  ? stand_in(*whole_scan, prediction, scan)
                                        : coast(prediction, scan.stamp(), doubt);
  judge_.end_scan();
  last_ = estimate.map_from_base;
  last_scan_ = scan.stamp();
  return estimate;
}

/// By the poses so far, and the wheels where they are trusted.
Prediction Follower::predict(const Scan& scan) {
  if (last_scan_ && odometry_->is_trusted())
    if (const auto told = odometry_->between(*last_scan_, scan.stamp()))
      motion_.hear(*told, seconds_between(*last_scan_, scan.stamp()));
  Prediction prediction = motion_.predict(scan.stamp());
  prediction.motion = sweep_->expect(scan, motion_);
  return prediction;
}

bool Follower::is_adrift() const {
  return judge_.health().lost() && judge_.health().is_weak(explained_) && !seen_->is_covered();
}

std::string_view Follower::caveat_of(const MatchResult& match, bool is_other) const {
  if (is_other || rivals_.any()) return kRivalled;
  return is_through_walls_ ? kThroughWalls : seen_->matcher().reservation(match);
}

PoseEstimate Follower::accept(const MatchResult& match, const Prediction& prediction, const Scan& scan,
                              std::string_view reservation) {
  // 1. The pose of the base, and what is known of it.
  PoseEstimate estimate;
  estimate.stamp = scan.stamp();
  estimate.map_from_base = match.map_from_laser * laser_from_base_;
  estimate.covariance = moved_covariance(match.covariance, match.map_from_laser, laser_from_base_);
  explained_ = match.on_map_ratio;
  // 2. Whether the map agrees. Found again means that the place holds from scan to scan.
  const bool was_lost = judge_.health().lost();
  if (was_lost && judge_.is_jump(match, prediction)) judge_.health().forget_found();
  estimate.status = judge_.health().judge(scan.stamp(), match.on_map_ratio);
  estimate.reason = reason_of(estimate.status, was_lost);
  shaken_.see_fit(estimate.status, was_lost);
  const bool is_lost = was_lost || estimate.status == Status::lost;
  if (estimate.status != Status::ok) estimate.covariance += is_lost ? kLostCovariance : kWeakCovariance;
  const Eigen::Matrix3d swept =
      sweep_->covariance(estimate.map_from_base, prediction.motion, scan, !judge_.is_first());
  // 3. What rests on the prediction, wholly or along some direction, is degraded and tells no velocity.
  const bool is_open = match.rank < 3;
  if (judge_.is_surprise(match, prediction)) {
    estimate.jumped = true;
    surprised_scans_ = kSurprised;
    shaken_.see_jump();
  } else if (surprised_scans_ > 0) {
    --surprised_scans_;
  }
  const std::string_view caveat = is_open                                       ? kOpenDirection
                                  : surprised_scans_ > 0 && reservation.empty() ? kSurprising
                                                                                : reservation;
  if (is_open) estimate.covariance = fused_covariance(estimate.covariance, prediction.covariance);
  if (estimate.status == Status::ok && !caveat.empty()) {
    estimate.status = Status::degraded;
    estimate.reason = caveat;
  }
  // A wrong motion moves this pose and the next one alike, which the filter compares.
  const Eigen::Matrix3d compared = seen_->is_unbent(scan) ? estimate.covariance : estimate.covariance + swept;
  estimate.covariance =
      symmetric(estimate.covariance + swept + rivals_.covariance(estimate.map_from_base, laser_from_base_));
  if (!estimate.map_from_base.is_finite() || !estimate.covariance.allFinite())
    return coast(prediction, scan.stamp(), "the fit gave no finite pose");
  protect(estimate, match, laser_from_base_, risk_, is_through_walls_);
  estimate.quality = trust_.quality(seen_->matcher().tells_protection() ? std::optional(estimate.protection_m)
                                                                        : std::nullopt);
  // A level takes the place for granted; where it is not, nothing bounds the error.
  if (!estimate.is_trusted()) {
    estimate.protection_m = PoseEstimate::kUnbounded_m;
    estimate.protection_rad = kPi;
  }
  // 4. What carries over to the next scan.
  const auto seen = motion_.told_by(scan.stamp(), estimate.map_from_base, compared);
  if (seen && last_scan_ && caveat.empty()) odometry_->compare(*last_scan_, scan.stamp(), *seen);
  // Wherever the robot is, one of two like places tells how it moves as well as the other.
  const bool is_of_place = caveat == kRivalled || caveat == kThroughWalls || caveat == kSurprising;
  if (caveat.empty() || (!is_open && is_of_place && !judge_.is_jump(match, prediction)))
    motion_.correct(scan.stamp(), estimate.map_from_base, compared);
  else
    motion_.hold(scan.stamp(), estimate.map_from_base, compared);
  if (sweep_->told()) motion_.hear(*sweep_->told(), scan.sweep_time_s());
  if (judge_.health().lost()) seen_->matcher().forget();
  seen_->matcher().settle(match);
  return estimate;
}

PoseEstimate Follower::stand_in(const MatchResult& whole_scan, const Prediction& prediction,
                                const Scan& scan) {
  PoseEstimate estimate = accept(whole_scan, prediction, scan, {});
  if (estimate.status != Status::ok) return estimate;
  estimate.status = Status::degraded;
  estimate.reason = "the method finds no pose here; this one is that of the whole scan against the walls";
  return estimate;
}

PoseEstimate Follower::coast(const Prediction& prediction, Stamp stamp, std::string_view reason) {
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_from_base = prediction.map_from_base;
  estimate.covariance = prediction.covariance;
  // A pose that nothing corrects is never ok; it is not lost as long as the scan lies on the map there.
  // What is usual is not learnt from it: it may drift away little by little.
  Health& health = judge_.health();
  explained_ = health.lost() || seen_->is_covered() ? 0.0 : seen_->fit_at(prediction).on_map_ratio;
  shaken_.see_none(!health.is_weak(explained_));
  estimate.quality = kUncorrected * explained_;
  if (health.is_weak(explained_)) health.judge(stamp, explained_);
  if (health.lost()) estimate.covariance += kLostCovariance;
  estimate.covariance = symmetric(estimate.covariance);
  estimate.status = health.lost() ? Status::lost : Status::degraded;
  estimate.reason = reason;
  return estimate;
}

}  // namespace beaconless
