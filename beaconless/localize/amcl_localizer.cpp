// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/amcl_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/localize/doubts.hpp"
#include "beaconless/match/map_fit.hpp"
#include "beaconless/scan/deskew.hpp"

namespace beaconless {
namespace {

constexpr double kNominalStep_s = 0.1;  // between scans whose stamps do not tell
constexpr double kUnplaced = 0.45;      // most quality of a pose that no start pose and no search vouches for
constexpr int kAgreed = 5;              // scans in a row that must find a robot in one place
constexpr double kRepeats = 0.04;       // of a cloud's variance, what its mean scatters by from scan to scan
constexpr double kFarFromCloud = 16.0;  // squared standard deviations
constexpr double kJump_m = 0.5;
constexpr double kJump_rad = radians(30.0);
constexpr std::size_t kChecks = 240;
constexpr std::size_t kFollowed = 180;  // points by which motion is followed without wheels
constexpr std::size_t kMostCandidates = 16;
constexpr double kLeastWeight = 0.01;  // of a candidate

double square(double value) { return value * value; }

}  // namespace

AmclLocalizer::AmclLocalizer(const LocalizerConfig& config, const Map& map,
                             std::shared_ptr<const SurfaceMap> surfaces, std::unique_ptr<ScanMatcher> polish)
    : config_(config),
      map_(std::move(surfaces)),
      polish_(std::move(polish)),
      cloud_(config, map, map_),
      motion_(config.motion),
      odometry_(config.odometry),
      health_(config.health) {}

void AmclLocalizer::begin() {
  health_ = Health(config_.health);
  candidates_.clear();
  last_scan_.reset();
  last_ = PoseEstimate{};
  last_.map_from_base = cloud_.now().map_from_base;
  motion_.start_at(cloud_.now().map_from_base);
  is_started_ = true;
  is_doubtful_ = false;
  agreed_ = 0;
}

void AmclLocalizer::start_at(const Pose2& map_from_base) {
  if (!map_from_base.is_finite()) return;
  cloud_.start_at(map_from_base);
  is_searching_ = false;
  is_placed_ = true;
  begin();
}

void AmclLocalizer::start_anywhere(const std::optional<SearchRegion>& within) {
  if (within && !(within->middle.allFinite() && std::isfinite(within->radius_m))) return;
  cloud_.start_anywhere(within);
  is_searching_ = true;
  is_placed_ = false;
  begin();
}

PoseEstimate AmclLocalizer::update(const Event& event) {
  const Scan* scan = std::get_if<Scan>(&event);
  if (const auto* odometry = std::get_if<Odometry>(&event))
    odometry_.add(odometry->stamp, odometry->odom_from_base);
  if (scan == nullptr || !is_started_) {
    PoseEstimate estimate = last_;
    estimate.stamp = stamp_of(event);
    estimate.status = is_started_ ? Status::not_a_scan : Status::not_started;
    estimate.reason = is_started_ ? "the event brought no scan" : "no start pose was given";
    return estimate;
  }
  // 1. How the robot has moved since the last scan.
  const AmclCloud::Step step = step_to(*scan);
  is_by_wheels_ = step.is_by_wheels;
  // 2. What the laser saw, as from where it was at the stamp.
  observe(*scan, step);
  // 3. The belief moves on, and the cloud with it where wheels do not tell the way.
  cloud_.carry(step);
  // 4. Where it has moved far enough, or the scan is doubted, the cloud is weighed and drawn anew.
  if (is_doubtful_ || cloud_.is_due(step)) cloud_.weigh(*scan, points_, health_.lost());
  // 5. The whole scan polishes what the cloud tells, where that is asked for.
  const Belief belief = polished(*scan);
  // 6. Whether the scan fits there, and the cloud agrees on one place.
  PoseEstimate estimate = judge(belief, *scan);
  // 7. Whether the belief has changed places, and if not, what motion follows.
  learn_motion(belief, scan->stamp(), estimate);
  last_ = estimate;
  last_scan_ = scan->stamp();
  return last_;
}

AmclCloud::Step AmclLocalizer::step_to(const Scan& scan) {
  AmclCloud::Step step;
  if (!last_scan_) return step;
  const double told_s = seconds_between(*last_scan_, scan.stamp());
  const double usual_s = last_step_s_ > 0.0 ? last_step_s_ : kNominalStep_s;
  const double elapsed_s = std::min(told_s > 0.0 ? told_s : usual_s, config_.motion.max_gap_s);
  last_step_s_ = elapsed_s;
  // 1. By wheels, whatever the time between.
  if (const auto told = odometry_.between(*last_scan_, scan.stamp())) {
    step.twist_per_s = {told->per_s.x(), told->per_s.y(), told->per_s.z()};
    step.motion = Pose2::exp(told_s * step.twist_per_s);
    step.is_by_wheels = step.motion.is_finite();
    if (step.is_by_wheels) return step;
  }
  // 2. As it moved of late.
  const ToldTwist motion = motion_.motion_at(scan.stamp());
  step.twist_per_s = {motion.per_s.x(), motion.per_s.y(), motion.per_s.z()};
  step.motion = Pose2::exp(elapsed_s * step.twist_per_s);
  step.covariance = elapsed_s * elapsed_s * motion.covariance;
  step.covariance.diagonal() +=
      Eigen::Vector3d(square(config_.amcl.still_sigma_m), square(config_.amcl.still_sigma_m),
                      square(config_.amcl.still_sigma_rad));
  return step;
}

void AmclLocalizer::observe(const Scan& scan, const AmclCloud::Step& step) {
  const Eigen::Vector3d twist = config_.base_from_laser.inverse().adjoint() * step.twist_per_s.vector();
  const bool is_swept = config_.deskew && scan.sweep_time_s() > 0.0;
  points_at_stamp(scan, is_swept ? Twist2{twist.x(), twist.y(), twist.z()} : Twist2{}, points_);
}

AmclLocalizer::Belief AmclLocalizer::polished(const Scan& scan) {
  const Belief& now = cloud_.now();
  if (!polish_ || !cloud_.is_one_place() || cloud_.is_wide()) return now;
  const Pose2 guess = now.map_from_base * config_.base_from_laser;
  polish_->observe(scan, points_, guess,
                   moved_covariance(now.covariance, now.map_from_base, config_.base_from_laser));
  return if_agreed(polish_->match(guess)).value_or(now);
}

AmclLocalizer::Belief AmclLocalizer::followed(const Belief& belief) {
  if (polish_) return belief;
  // What a mean of particles scatters by from scan to scan hides the motion of a robot for a second or so;
  // what a match of the scan scatters by does not.
  if (!is_by_wheels_) {
    choose_points();
    const Pose2 guess = cloud_.now().map_from_base * config_.base_from_laser;
    if (const auto matched = if_agreed(match_icp(few_points_, *map_, guess, config_.icp, icp_scratch_)))
      return *matched;
  }
  return {belief.map_from_base, kRepeats * belief.covariance};
}

void AmclLocalizer::choose_points() {
  few_points_.clear();
  const std::size_t stride = std::max<std::size_t>(1, points_.size() / kFollowed);
  for (std::size_t i = 0; i < points_.size(); i += stride) few_points_.push_back(points_[i]);
}

std::optional<AmclLocalizer::Belief> AmclLocalizer::if_agreed(const MatchResult& match) const {
  if (!match.usable()) return std::nullopt;
  const Belief& now = cloud_.now();
  const Pose2 laser_from_base = config_.base_from_laser.inverse();
  Belief belief{match.map_from_laser * laser_from_base,
                moved_covariance(match.covariance, match.map_from_laser, laser_from_base)};
  if (match.rank < 3) belief.covariance = fused_covariance(belief.covariance, now.covariance);
  const Eigen::Vector3d off(belief.map_from_base.x_m - now.map_from_base.x_m,
                            belief.map_from_base.y_m - now.map_from_base.y_m,
                            wrap_angle(belief.map_from_base.theta_rad - now.map_from_base.theta_rad));
  const Eigen::Matrix3d expected = now.covariance + belief.covariance + 1e-8 * Eigen::Matrix3d::Identity();
  const bool agrees = off.dot(expected.ldlt().solve(off)) < kFarFromCloud;
  if (!agrees || !belief.map_from_base.is_finite() || !belief.covariance.allFinite()) return std::nullopt;
  return belief;
}

PoseEstimate AmclLocalizer::judge(const Belief& belief, const Scan& scan) {
  // 1. The pose, and whether the scan fits there.
  PoseEstimate estimate;
  estimate.stamp = scan.stamp();
  estimate.map_from_base = belief.map_from_base;
  estimate.covariance = belief.covariance;
  const double explained = explained_share(belief.map_from_base);
  is_doubtful_ = health_.is_doubtful(explained);
  const bool was_lost = health_.lost();
  estimate.status = health_.judge(scan.stamp(), explained);
  // Particles that were spread anywhere may have settled on one of two like places.
  estimate.quality = std::min(is_placed_ ? 1.0 : kUnplaced, explained * cloud_.heaviest());
  estimate.reason = reason_of(estimate.status, was_lost);
  // 2. Whether the cloud agrees on one place, for some scans after a start anywhere.
  const bool agrees = cloud_.is_one_place() && !cloud_.is_wide() && estimate.ok();
  agreed_ = agrees ? agreed_ + 1 : 0;
  if (agreed_ >= kAgreed) is_searching_ = false;
  const std::string_view doubts = doubt();
  const bool is_settled = estimate.status != Status::lost || is_searching_;
  if (is_settled && !doubts.empty() && !(estimate.status == Status::degraded && !is_searching_)) {
    const bool is_between = is_searching_ || !cloud_.is_one_place();
    estimate.status = is_between ? Status::relocalizing : Status::degraded;
    estimate.reason = doubts;
  }
  list_candidates();
  // 3. How much less is known where it is not to be trusted.
  if (estimate.status == Status::lost)
    estimate.covariance += kLostCovariance;
  else if (estimate.status != Status::ok)
    estimate.covariance += kWeakCovariance;
  estimate.covariance = symmetric(estimate.covariance);
  // A cloud absurdly far away has squares that no number holds.
  if (!estimate.covariance.allFinite()) estimate.covariance = PoseEstimate{}.covariance;
  return estimate;
}

void AmclLocalizer::learn_motion(const Belief& belief, Stamp stamp, PoseEstimate& estimate) {
  const Pose2 moved = last_.map_from_base.inverse() * belief.map_from_base;
  const double slack_m = 3.0 * std::sqrt(belief.covariance.topLeftCorner<2, 2>().trace());
  estimate.jumped = last_scan_.has_value() && (std::hypot(moved.x_m, moved.y_m) > kJump_m + slack_m ||
                                               std::abs(moved.theta_rad) > kJump_rad);
  if (estimate.jumped || is_searching_ || health_.lost() || !belief.covariance.allFinite()) {
    motion_.start_at(belief.map_from_base);
    return;
  }
  const Belief seen = followed(belief);
  motion_.correct(stamp, seen.map_from_base, symmetric(seen.covariance));
}

std::string_view AmclLocalizer::doubt() const {
  if (cloud_.is_blind()) return "the scan has no beam that could weigh particles";
  if (!cloud_.is_one_place()) return "the particles are in several places that fit";
  if (cloud_.is_wide()) return "the particles are spread wider than a pose can be told from";
  if (is_searching_) return "the particles have met in one place; more scans must agree";
  return {};
}

void AmclLocalizer::list_candidates() {
  candidates_.clear();
  if (cloud_.is_one_place() && !is_searching_) return;
  double all = 0.0;
  std::size_t looked_at = 0;
  for (const Cluster& cluster : cloud_.clusters()) {
    if (looked_at++ == kMostCandidates || (cluster.weight < kLeastWeight && !candidates_.empty())) break;
    const double score = explained_share(cluster.mean);
    if (score == 0.0) continue;  // the mean of a wide cluster may be where nobody stands
    candidates_.push_back({cluster.mean, score, cluster.weight});
    all += cluster.weight;
  }
  for (PoseCandidate& candidate : candidates_) candidate.weight /= all;
}

double AmclLocalizer::explained_share(const Pose2& map_from_base) const {
  return fit_to_map(points_, *map_, map_from_base * config_.base_from_laser, config_.amcl.on_map_m,
                    points_.size() / kChecks)
      .on_map_ratio;
}

}  // namespace beaconless
