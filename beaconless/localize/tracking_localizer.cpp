// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/tracking_localizer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/localize/doubts.hpp"
#include "beaconless/localize/protect.hpp"
#include "beaconless/match/sidesteps.hpp"
#include "beaconless/match/sweep_twist.hpp"
#include "beaconless/scan/deskew.hpp"

namespace beaconless {
namespace {

constexpr double kClearlyBetter = 0.05;  // in misfit, before another start is preferred to the prediction
constexpr double kBetter = 0.01;         // the same, to one that the search found first
constexpr double kJumpSigma =
    3.0;  // of the prediction; a larger correction is a jump, if also larger than the next two
constexpr double kJump_m = 0.25;
constexpr double kJump_rad = radians(8.0);
// What no motion explains is announced, and others must agree before it is called ok.
constexpr double kSurprise_sigma = 4.0;
constexpr double kSurprise_m = 0.06;
constexpr double kSurprise_rad = radians(2.0);
constexpr int kSurprised = 5;     // scans
constexpr double kStart_m = 1.8;  // what a start pose may be off …
constexpr double kStart_rad = radians(60.0);
constexpr double kCovered_m = 0.5;      // where fewer beams than the next share reach further than this …
constexpr double kCoveredShare = 0.05;  // … anything fits anywhere
constexpr double kLostWindow = 2.5;     // how much wider a lost robot searches
constexpr double kVague_m = 0.1;        // a prediction less certain than this is not gone by …
constexpr double kVague_rad = radians(5.0);  // … where the whole scan tells better
constexpr std::size_t kChecks = 240;         // beams that check a pose: the share is then known to 3 %

constexpr double kSkew_m = 2e-4;  // what a twist misplaces by less than both is not worth a second fit
constexpr double kSkew_rad = 1e-4;
constexpr int kMostRepeats =
    4;  // of a fit by another motion: one is the rule, more at a start in full motion
constexpr double kUnsure_m =
    1e-3;  // … and what it is uncertain by less than both need not be told by the sweep
constexpr double kUnsure_rad = 1e-3;

constexpr std::string_view kRivalled = "another place nearby fits the scan nearly as well";

constexpr std::string_view kLikeOthers = "another place of the map fits the scans about as well";
constexpr std::string_view kElsewhere = "the scans fit another place of the map far better";
constexpr std::string_view kSurprising = "the pose has just jumped; more scans must agree";
constexpr std::string_view kFarFromStart = "the scan fits only far from the start pose";
constexpr double kBent_m = 0.01;  // half a sweep that places beams this far off is seen anew
constexpr double kBent_rad = radians(0.2);
constexpr double kThroughWalls_share = 0.2;
constexpr double kThrough_s = 2.0;    // of that put the place in doubt
constexpr int kShaking = 2;           // and so do so many scans in a row that fit nowhere
constexpr double kDoubted = 0.45;     // most quality of a pose whose place is in doubt
constexpr double kUncorrected = 0.4;  // most quality of a pose that no fit has corrected
constexpr std::string_view kThroughWalls = "many beams would have to pass through walls of the map";

constexpr std::string_view kOpenDirection =
    "the walls in view leave a direction open, which is held at the prediction";

constexpr std::string_view kCovered =
    "the scanner seems to be covered: hardly a beam comes from further than half a metre";

/// Whether hardly a beam comes from far away. Mostly the first few tell.
bool is_covered(std::span<const Eigen::Vector2d> points, std::size_t beams) {
  const double enough = kCoveredShare * static_cast<double>(beams);
  double far = 0.0;
  for (const Eigen::Vector2d& point : points) {
    if (far >= enough) break;
    if (point.squaredNorm() > kCovered_m * kCovered_m) far += 1.0;
  }
  return far < enough;
}

/// Whether the motion so far no longer tells where the robot is.
bool is_vague(const Prediction& prediction) {
  return prediction.covariance.topLeftCorner<2, 2>().trace() > kVague_m * kVague_m ||
         prediction.covariance(2, 2) > kVague_rad * kVague_rad;
}

}  // namespace

TrackingLocalizer::TrackingLocalizer(const LocalizerConfig& config, std::shared_ptr<const SurfaceMap> map,
                                     std::unique_ptr<ScanMatcher> matcher)
    : config_(config),
      map_(std::move(map)),
      matcher_(std::move(matcher)),
      nearness_(*map_, config.search.cell_m, config.search.truncate_m),
      laser_from_base_(config.base_from_laser.inverse()),
      motion_(config.motion),
      odometry_(config.odometry),
      finder_(config.places, map_, config.icp, config.walls),
      relocalizer_(finder_, laser_from_base_),
      watch_(finder_),
      health_(config.health) {}

void TrackingLocalizer::start_at(const Pose2& map_from_base) {
  if (!map_from_base.is_finite()) return;
  motion_.start_at(map_from_base);
  health_ = Health(config_.health);
  matcher_->forget();
  rivals_.clear();
  is_through_walls_ = false;
  last_scan_.reset();
  last_ = PoseEstimate{};
  last_.map_from_base = map_from_base;
  started_ = true;
  is_anywhere_ = false;
  is_new_place_ = false;
  relocalizer_.forget();
  watch_.forget();
  explained_ = 0.0;
  lost_scans_ = 0;
  surprised_scans_ = 0;
  coasted_scans_ = 0;
  weak_scans_ = 0;
  is_shaken_ = false;
  through_since_.reset();
  way_.begin();
  first_scan_ = true;
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
  health_ = Health(config_.health);
  was_placed_ = false;
  search_anywhere(box, 1, std::move(wanted));
}

PoseEstimate TrackingLocalizer::update(const Event& event) {
  const Scan* scan = std::get_if<Scan>(&event);
  if (const auto* odometry = std::get_if<Odometry>(&event))
    odometry_.add(odometry->stamp, odometry->odom_from_base);
  if (scan == nullptr || !(started_ || is_anywhere_)) {
    PoseEstimate estimate = last_;
    estimate.stamp = stamp_of(event);
    estimate.status =
        scan == nullptr && (started_ || is_anywhere_) ? Status::not_a_scan : Status::not_started;
    estimate.reason =
        estimate.status == Status::not_a_scan ? "the event brought no scan" : "no start pose was given";
    return estimate;
  }
  // 1. A robot that may be anywhere is looked for, and followed from where it is found.
  if (is_anywhere_) {
    if (const auto estimate = find(*scan)) return last_ = *estimate;
  }
  // 2. One that is somewhere is followed.
  const bool is_found = is_new_place_;
  last_ = track(*scan);
  last_.jumped = last_.jumped || is_found;
  is_new_place_ = false;
  // 3. Where that place is in doubt, it is held against all others.
  hold_against_others(*scan);
  // 4. One that is no longer there may be anywhere.
  const bool is_adrift = health_.lost() && health_.is_weak(explained_) && !is_covered_;
  const bool has_parted = way_.part(scan->stamp(), last_.map_from_base, odometry_);
  if (config_.relocalize && !is_anywhere_ &&
      (is_adrift || (has_parted && !relocalizer_.is_only_at(last_.map_from_base, scan->stamp(), points_))))
    search_anywhere(bounds_of(*map_), config_.health.found_after_scans);
  return last_;
}

void TrackingLocalizer::search_anywhere(const FloorPlan::Bounds& box, int agreeing_scans,
                                        PlaceFinder::Wanted wanted) {
  is_anywhere_ = true;
  found_motion_.reset();
  relocalizer_.begin(box, agreeing_scans, std::move(wanted));
}

void TrackingLocalizer::hold_against_others(const Scan& scan) {
  // 1. Whether there is any doubt.
  const bool is_fitted = coasted_scans_ == 0 && weak_scans_ == 0;
  if ((coasted_scans_ > 0 && coasted_scans_ < kShaking) || is_covered_ || last_.status == Status::lost ||
      rivals_.any() || !config_.relocalize)
    return;
  if (is_long_through_walls(scan.stamp())) is_shaken_ = true;
  if (is_shaken_) watch_.doubt_followed(last_.map_from_base * config_.base_from_laser);
  is_shaken_ = false;
  if (!watch_.is_in_doubt()) return;
  const PlaceWatch::Finding finding =
      watch_.see(scan.stamp(), points_, last_.map_from_base * config_.base_from_laser, is_fitted);
  if (finding == PlaceWatch::Finding::beyond_doubt) return;
  // 2. What is in doubt is not to be relied on.
  last_.quality = std::min(last_.quality, kDoubted);
  last_.protection_m = PoseEstimate::kUnbounded_m;
  last_.protection_rad = kPi;
  // 3. What has its like in the map is degraded; what is elsewhere is lost.
  if (finding == PlaceWatch::Finding::rivalled && last_.ok()) {
    last_.status = Status::degraded;
    last_.reason = kLikeOthers;
  }
  if (finding == PlaceWatch::Finding::elsewhere) {
    last_.status = Status::lost;
    last_.reason = kElsewhere;
    last_.covariance += kLostCovariance;
    is_anywhere_ = true;
    relocalizer_.go_on(config_.health.found_after_scans);
  }
}

/// Takes over how the robot moved since the scan before, from the places where it may be.
void TrackingLocalizer::hear_search(const Scan& scan, const Stamp& before) {
  found_motion_.reset();
  const double dt = seconds_between(before, scan.stamp());
  if (!finder_.moved() || !(dt > 0.0)) return;
  const Twist2 way = (config_.base_from_laser * *finder_.moved() * laser_from_base_).log();
  found_motion_ = ToldTwist{way.vector() / dt, Eigen::Matrix3d::Zero()};
}

bool TrackingLocalizer::is_bent_by(const ToldTwist& motion, const Scan& scan) const {
  const Eigen::Vector3d skew = 0.5 * scan.sweep_time_s() * motion.per_s;
  return is_swept(scan) && (skew.head<2>().norm() > kBent_m || std::abs(skew.z()) > kBent_rad);
}

bool TrackingLocalizer::is_long_through_walls(Stamp stamp) {
  if (!is_through_walls_) through_since_.reset();
  if (is_through_walls_ && !through_since_) through_since_ = stamp;
  if (!through_since_ || seconds_between(*through_since_, stamp) < kThrough_s) return false;
  through_since_ = stamp;
  return true;
}

std::optional<PoseEstimate> TrackingLocalizer::find(const Scan& scan) {
  // 1. How the robot moves, by the wheels or by the scans before, and what the laser saw. What was seen
  //    before that was known is seen anew, if it makes a difference.
  const auto told = last_scan_ ? odometry_.between(*last_scan_, scan.stamp()) : std::nullopt;
  Prediction moving;
  moving.map_from_base = last_.map_from_base;
  moving.motion = told ? *told : found_motion_.value_or(ToldTwist{});
  if (found_motion_ && was_seen_standing_ && is_bent_by(moving.motion, scan)) finder_.begin_again();
  was_seen_standing_ = !told && !found_motion_;
  std::optional<Pose2> moved;
  if (last_scan_ && !was_seen_standing_) {
    const Eigen::Vector3d way = moving.motion.per_s * seconds_between(*last_scan_, scan.stamp());
    moved = laser_from_base_ * Pose2::exp(Twist2{way.x(), way.y(), way.z()}) * config_.base_from_laser;
  }
  observe(scan, moving.map_from_base * config_.base_from_laser, kLostCovariance, moving);
  const std::optional<Stamp> before = std::exchange(last_scan_, scan.stamp());
  // 2. What that tells of where it is.
  std::optional<PoseEstimate> estimate =
      is_covered_ ? relocalizer_.nowhere(scan.stamp(), last_.map_from_base, kCovered)
                  : relocalizer_.see(scan.stamp(), points_, moved, last_.map_from_base);
  if (before && !is_covered_) hear_search(scan, *before);
  if (estimate) return estimate;
  // 3. It is there.
  const bool was_placed = was_placed_;
  start_at(relocalizer_.found());
  watch_.doubt_found();
  is_new_place_ = was_placed;
  return std::nullopt;
}

PoseEstimate TrackingLocalizer::track(const Scan& scan) {
  // 1. Where the robot should be by its motion so far.
  if (last_scan_ && odometry_.is_trusted())
    if (const auto told = odometry_.between(*last_scan_, scan.stamp()))
      motion_.hear(*told, seconds_between(*last_scan_, scan.stamp()));
  Prediction prediction = motion_.predict(scan.stamp());
  prediction.motion = motion_during(scan, motion_);
  bent_.reset();
  const Pose2 guess = prediction.map_from_base * config_.base_from_laser;
  // 2. What the laser saw.
  observe(scan, guess,
          moved_covariance(prediction.covariance, prediction.map_from_base, config_.base_from_laser),
          prediction);
  const bool is_anywhere = first_scan_ || health_.lost();
  rivals_.forget_notes();
  const Pose2 before = last_.map_from_base * config_.base_from_laser;
  // 3. Fit it to the map from there.
  MatchResult match = fit_from(guess);
  std::optional<MatchResult> whole_scan;
  // 4. Where that fit is hard to believe, fit from other starts too and take the best; where the method gets
  //    nowhere from any of them, let the whole scan tell.
  if (is_worth_searching(match, prediction)) {
    const std::span<const StartPose> starts = starts_around(prediction);
    match = best_of(starts, match, prediction, [&](const Pose2& start) { return fit_from(start); });
    if (first_scan_ || !reason_against(match, prediction).empty())
      whole_scan = fit_whole_scan(starts, prediction);
  } else if (is_through_walls_ && match.usable()) {
    starts_.clear();
    for (const Pose2& beside : sidesteps(match.map_from_laser)) starts_.push_back({beside});
    match = best_of(starts_, match, prediction, [&](const Pose2& start) { return fit_from(start); });
  } else if (!match.usable() && is_vague(prediction)) {
    const StartPose there{guess};
    whole_scan = fit_whole_scan({&there, 1}, prediction);
  }
  // 5. Where the fit tells another motion during the sweep, see the sweep by that.
  if (reason_against(match, prediction).empty()) match = fit_by_new_motion(match, prediction, scan);
  // 6. Whether another place fits as well: looked for where the robot could be anywhere, then followed,
  //    and taken once it fits better.
  bool is_other = false;
  if (is_anywhere)
    rivals_.look(match);
  else if (rivals_.any())
    is_other = rivals_.follow(match, before.inverse() * match.map_from_laser,
                              [&](const Pose2& place) { return fit_from(place); });
  // 7. Whether beams would have to pass through walls there, which nothing in the way explains.
  if (is_anywhere) trust_.begin();
  trust_.see(points_, *map_, match, config_.places.sigma_m);
  is_through_walls_ = trust_.through() > kThroughWalls_share;
  // 8. Take the fit as the pose, or what the whole scan told, or go on by the motion alone.
  std::string_view doubt = is_other ? std::string_view{} : reason_against(match, prediction);
  if (doubt.empty() && whole_scan && whole_scan->misfit < match.misfit - kClearlyBetter)
    doubt = "the whole scan fits another place far better";
  PoseEstimate estimate = doubt.empty() ? accept(match, prediction, scan, caveat_of(match, is_other))
                          : whole_scan  ? stand_in(*whole_scan, prediction, scan)
                                        : coast(prediction, scan.stamp(), doubt);
  first_scan_ = false;
  last_scan_ = scan.stamp();
  was_placed_ = was_placed_ || estimate.ok();
  return estimate;
}

bool TrackingLocalizer::is_worth_searching(const MatchResult& match, const Prediction& prediction) {
  if (health_.lost() && health_.is_weak(match.on_map_ratio))
    return lost_scans_++ % config_.search.lost_stride == 0;
  lost_scans_ = 0;
  if (first_scan_) return true;
  // A matcher that has too little to hold on to needs no other start where the prediction is right.
  if (!match.usable()) return health_.is_doubtful(fit_at(prediction).on_map_ratio);
  return health_.is_doubtful(match.on_map_ratio) || is_jump(match, prediction);
}

std::string_view TrackingLocalizer::reason_to_coast(const MatchResult& match,
                                                    const Prediction& prediction) const {
  if (is_covered_) return kCovered;
  if (!match.usable()) return matcher_->too_few_pairs();
  if (!health_.at_home() && health_.is_weak(match.on_map_ratio))
    return first_scan_ || !health_.lost() ? "the scan fits nowhere around the start pose"
                                          : "the scan fits nowhere around the last trusted pose";
  if (first_scan_ && is_further(match, prediction, {0.0, kStart_m, kStart_rad})) return kFarFromStart;
  if (first_scan_ || health_.lost()) return {};
  if (is_jump(match, prediction)) return "the scan fits nowhere near the predicted pose";
  return {};
}

std::string_view TrackingLocalizer::reason_against(const MatchResult& match,
                                                   const Prediction& prediction) const {
  const std::string_view reason = reason_to_coast(match, prediction);
  return reason.empty() ? reason_against_features(match, prediction) : reason;
}

std::string_view TrackingLocalizer::reason_against_features(const MatchResult& match,
                                                            const Prediction& prediction) const {
  if (matcher_->judges_whole_scan() || first_scan_ || health_.lost()) return {};
  if (health_.is_weak(match.on_map_ratio)) return "the features fit, but too little of the rest of the scan";
  if (match.misfit > kClearlyBetter && match.misfit > fit_at(prediction).misfit + kClearlyBetter)
    return "the features fit, but the rest of the scan fits the predicted pose far better";
  return {};
}

bool TrackingLocalizer::is_swept(const Scan& scan) const {
  return config_.deskew && matcher_->judges_whole_scan() && scan.sweep_time_s() > 0.0;
}

void TrackingLocalizer::observe(const Scan& scan, const Pose2& map_from_laser,
                                const Eigen::Matrix3d& covariance, const Prediction& prediction) {
  const Eigen::Vector3d twist = laser_from_base_.adjoint() * prediction.motion.per_s;
  points_at_stamp(scan, is_swept(scan) ? Twist2{twist.x(), twist.y(), twist.z()} : Twist2{}, points_);
  is_covered_ = is_covered(points_, scan.size());
  matcher_->observe(scan, points_, map_from_laser, covariance);
}

ToldTwist TrackingLocalizer::motion_during(const Scan& scan, MotionFilter motion) const {
  const auto told = odometry_.between(scan.stamp(), scan.stamp() + scan.sweep_time_s());
  if (told && odometry_.is_trusted()) motion.hear(*told, scan.sweep_time_s());
  return motion.motion_at(scan.stamp());
}

std::optional<ToldTwist> TrackingLocalizer::told_by_sweep(const Scan& scan, const MatchResult& match,
                                                          const ToldTwist& assumed) {
  times_s_.clear();
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam)) times_s_.push_back(scan.beam_time_s(beam));
  const bool is_walls = config_.method == "walls";
  const SweepNoise noise{is_walls ? config_.walls.sigma_m : config_.icp.sigma_m,
                         is_walls ? config_.walls.map_sigma_m : config_.icp.map_sigma_m, match.scale_m};
  const auto bent = twist_of_sweep(points_, times_s_, *map_, match.map_from_laser, noise);
  if (!bent) return std::nullopt;
  const Eigen::Matrix3d to_base = config_.base_from_laser.adjoint();
  return ToldTwist{assumed.per_s + to_base * bent->correction_per_s,
                   to_base * bent->covariance * to_base.transpose()};
}

MatchResult TrackingLocalizer::fit_by_new_motion(const MatchResult& first, Prediction& prediction,
                                                 const Scan& scan) {
  MatchResult match = first;
  const double half_s = 0.5 * scan.sweep_time_s();
  for (int again = 0; again < kMostRepeats && is_swept(scan) && match.rank == 3; ++again) {
    // 1. The motion, now that the pose is known, and by how the sweep is bent where that is uncertain.
    MotionFilter after = motion_;
    after.correct(scan.stamp(), match.map_from_laser * laser_from_base_,
                  moved_covariance(match.covariance, match.map_from_laser, laser_from_base_));
    ToldTwist motion = motion_during(scan, after);
    if (half_s * std::sqrt(motion.covariance.topLeftCorner<2, 2>().trace()) > kUnsure_m ||
        half_s * std::sqrt(motion.covariance(2, 2)) > kUnsure_rad) {
      bent_ = told_by_sweep(scan, match, prediction.motion);
      if (bent_ && after.hear(*bent_, scan.sweep_time_s())) motion = motion_during(scan, after);
    }
    // 2. Once more by it, if it is another one.
    const Eigen::Vector3d skew = half_s * (motion.per_s - prediction.motion.per_s);
    prediction.motion = motion;
    if (skew.head<2>().norm() < kSkew_m && std::abs(skew.z()) < kSkew_rad) break;
    observe(scan, match.map_from_laser, match.covariance + Eigen::Matrix3d(skew.cwiseAbs2().asDiagonal()),
            prediction);
    const MatchResult next = fit_from(match.map_from_laser);
    if (!next.usable()) break;
    match = next;
  }
  return match;
}

/// What the motion during a sweep adds to the error of a pose: all of it where the sweep is fitted as if seen
/// at once; by how much it is not known where it is fitted by that motion. The fit is right for some moment
/// of the sweep, half of it from the stamp on average.
Eigen::Matrix3d TrackingLocalizer::sweep_covariance(const PoseEstimate& estimate,
                                                    const Prediction& prediction, const Scan& scan) const {
  const double half_s = 0.5 * scan.sweep_time_s();
  const Eigen::Matrix3d to_map = turn_of(estimate.map_from_base);
  Eigen::Matrix3d unknown = half_s * half_s * to_map * prediction.motion.covariance * to_map.transpose();
  if (is_swept(scan)) return unknown;
  const Eigen::Vector3d error = to_map * (half_s * prediction.motion.per_s);
  return first_scan_ ? unknown : Eigen::Matrix3d(error * error.transpose());
}

MatchResult TrackingLocalizer::fit_from(const Pose2& guess) {
  MatchResult match = matcher_->match(guess);
  if (!match.usable() || matcher_->judges_whole_scan()) return match;
  // A dozen corners can fit a wrong place; beams from all around that then do not lie on the map tell.
  const std::size_t stride = points_.size() / kChecks;
  const MapFit fit = fit_to_map(points_, *map_, match.map_from_laser, config_.icp.on_map_m, stride);
  match.on_map_ratio = fit.on_map_ratio;
  match.misfit = fit.misfit;
  return match;
}

MapFit TrackingLocalizer::fit_at(const Prediction& prediction) const {
  return fit_to_map(points_, *map_, prediction.map_from_base * config_.base_from_laser, config_.icp.on_map_m);
}

bool TrackingLocalizer::is_further(const MatchResult& match, const Prediction& prediction,
                                   const Tolerance& than) const {
  const Pose2 correction = prediction.map_from_base.inverse() * match.map_from_laser * laser_from_base_;
  const double slack_m = than.sigmas * std::sqrt(prediction.covariance.topLeftCorner<2, 2>().trace());
  const double slack_rad = than.sigmas * std::sqrt(prediction.covariance(2, 2));
  return std::hypot(correction.x_m, correction.y_m) > std::max(than.position_m, slack_m) ||
         std::abs(correction.theta_rad) > std::max(than.heading_rad, slack_rad);
}

bool TrackingLocalizer::is_jump(const MatchResult& match, const Prediction& prediction) const {
  return is_further(match, prediction, {kJumpSigma, kJump_m, kJump_rad});
}

std::span<const StartPose> TrackingLocalizer::starts_around(const Prediction& prediction) {
  LocalSearchConfig window = config_.search;
  if (health_.lost()) {
    window.window_m *= kLostWindow;
    window.window_deg = 180.0;
  } else {
    const double slack_m =
        2.0 * std::sqrt(std::max(0.0, prediction.covariance.topLeftCorner<2, 2>().trace()));
    window.window_m = std::clamp(slack_m, window.window_m, kLostWindow * window.window_m);
  }
  search_around(points_, nearness_, prediction.map_from_base * config_.base_from_laser, window,
                search_scratch_, starts_);
  return starts_;
}

template <class Fit>
MatchResult TrackingLocalizer::best_of(std::span<const StartPose> starts, const MatchResult& first,
                                       const Prediction& prediction, const Fit& fit) {
  // While the robot is not lost, a place that it cannot have reached since the last scan is no answer,
  // however well the scan fits there.
  const bool anywhere = first_scan_ || health_.lost();
  MatchResult best = first;
  bool best_is_first = true;
  rivals_.note(first);
  if (!anywhere && is_jump(first, prediction)) best.misfit = 1.0;
  for (const StartPose& start : starts) {
    const MatchResult other = fit(start.map_from_laser);
    if (!other.usable() || (!anywhere && is_jump(other, prediction))) continue;
    rivals_.note(other);
    if (best.usable() && other.misfit > best.misfit - (best_is_first ? kClearlyBetter : kBetter)) continue;
    best = other;
    best_is_first = false;
  }
  return best;
}

std::string_view TrackingLocalizer::caveat_of(const MatchResult& match, bool is_other) const {
  if (is_other || rivals_.any()) return kRivalled;
  return is_through_walls_ ? kThroughWalls : matcher_->reservation(match);
}

std::optional<MatchResult> TrackingLocalizer::fit_whole_scan(std::span<const StartPose> starts,
                                                             const Prediction& prediction) {
  if (matcher_->judges_whole_scan() || is_covered_) return std::nullopt;
  const MatchResult best = best_of(starts, MatchResult{}, prediction, [&](const Pose2& start) {
    return match_icp(points_, *map_, start, config_.icp, scratch_);
  });
  rivals_.forget_notes();  // those were fits of another kind than the method's
  if (!reason_to_coast(best, prediction).empty()) return std::nullopt;
  return best;
}

PoseEstimate TrackingLocalizer::accept(const MatchResult& match, const Prediction& prediction,
                                       const Scan& scan, std::string_view reservation) {
  // 1. The pose of the base, and what is known of it.
  PoseEstimate estimate;
  estimate.stamp = scan.stamp();
  estimate.map_from_base = match.map_from_laser * laser_from_base_;
  estimate.covariance = moved_covariance(match.covariance, match.map_from_laser, laser_from_base_);
  explained_ = match.on_map_ratio;
  // 2. Whether the map agrees. Found again means that the place holds from scan to scan.
  const bool was_lost = health_.lost();
  if (was_lost && is_jump(match, prediction)) health_.forget_found();
  estimate.status = health_.judge(scan.stamp(), match.on_map_ratio);
  estimate.reason = reason_of(estimate.status, was_lost);
  is_shaken_ = is_shaken_ || was_lost || coasted_scans_ >= kShaking;
  coasted_scans_ = 0;
  if (estimate.status != Status::ok && weak_scans_++ == 0) is_shaken_ = true;
  if (estimate.status == Status::ok) weak_scans_ = 0;
  const bool is_lost = was_lost || estimate.status == Status::lost;
  if (estimate.status != Status::ok) estimate.covariance += is_lost ? kLostCovariance : kWeakCovariance;
  const Eigen::Matrix3d swept = sweep_covariance(estimate, prediction, scan);
  // 3. What rests on the prediction, wholly or along some direction, is degraded and tells no velocity.
  const bool is_open = match.rank < 3;
  if (!first_scan_ && is_further(match, prediction, {kSurprise_sigma, kSurprise_m, kSurprise_rad})) {
    estimate.jumped = true;
    surprised_scans_ = kSurprised;
    is_shaken_ = true;
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
  const Eigen::Matrix3d compared = is_swept(scan) ? estimate.covariance : estimate.covariance + swept;
  estimate.covariance =
      symmetric(estimate.covariance + swept + rivals_.covariance(estimate.map_from_base, laser_from_base_));
  if (!estimate.map_from_base.is_finite() || !estimate.covariance.allFinite())
    return coast(prediction, scan.stamp(), "the fit gave no finite pose");
  protect(estimate, match, laser_from_base_, config_.walls.protection.risk, is_through_walls_);
  estimate.quality =
      trust_.quality(matcher_->tells_protection() ? std::optional(estimate.protection_m) : std::nullopt);
  // A level takes the place for granted; where it is not, nothing bounds the error.
  if (!estimate.is_trusted()) {
    estimate.protection_m = PoseEstimate::kUnbounded_m;
    estimate.protection_rad = kPi;
  }
  // 4. What carries over to the next scan.
  const auto seen = motion_.told_by(scan.stamp(), estimate.map_from_base, compared);
  if (seen && last_scan_ && caveat.empty()) odometry_.compare(*last_scan_, scan.stamp(), *seen);
  // Wherever the robot is, one of two like places tells how it moves as well as the other.
  const bool is_of_place = caveat == kRivalled || caveat == kThroughWalls || caveat == kSurprising;
  if (caveat.empty() || (!is_open && is_of_place && !is_jump(match, prediction)))
    motion_.correct(scan.stamp(), estimate.map_from_base, compared);
  else
    motion_.hold(scan.stamp(), estimate.map_from_base, compared);
  if (bent_) motion_.hear(*bent_, scan.sweep_time_s());
  if (health_.lost()) matcher_->forget();
  matcher_->settle(match);
  return estimate;
}

PoseEstimate TrackingLocalizer::stand_in(const MatchResult& whole_scan, const Prediction& prediction,
                                         const Scan& scan) {
  PoseEstimate estimate = accept(whole_scan, prediction, scan, {});
  if (estimate.status != Status::ok) return estimate;
  estimate.status = Status::degraded;
  estimate.reason = "the method finds no pose here; this one is that of the whole scan against the walls";
  return estimate;
}

PoseEstimate TrackingLocalizer::coast(const Prediction& prediction, Stamp stamp, std::string_view reason) {
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_from_base = prediction.map_from_base;
  estimate.covariance = prediction.covariance;
  // A pose that nothing corrects is never ok; it is not lost as long as the scan lies on the map there.
  // What is usual is not learnt from it: it may drift away little by little.
  const double explained = health_.lost() || is_covered_ ? 0.0 : fit_at(prediction).on_map_ratio;
  explained_ = explained;
  // Where only the method finds too little, the scan still tells that the robot is where it was.
  coasted_scans_ = health_.is_weak(explained) ? coasted_scans_ + 1 : 0;
  is_shaken_ = is_shaken_ || coasted_scans_ == kShaking;
  estimate.quality = kUncorrected * explained;
  if (health_.is_weak(explained)) health_.judge(stamp, explained);
  if (health_.lost()) estimate.covariance += kLostCovariance;
  estimate.covariance = symmetric(estimate.covariance);
  estimate.status = health_.lost() ? Status::lost : Status::degraded;
  estimate.reason = reason;
  return estimate;
}

}  // namespace beaconless
