// SPDX-License-Identifier: Apache-2.0
#include "beaconless/slam/hector_slam.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {
namespace {

constexpr double kFarthest_m = 1e5;
constexpr double kClearlyBetter = 0.03;  // in score, before another pose is preferred to that of the motion
constexpr double kCoarsestSearch_m = 0.201;
constexpr double kWidest_m = 2.0;  // no further is searched, however long nothing held
constexpr int kSearchStride = 4;   // a lost robot searches with every so many scans

/// The coarsest level that still shows a room's shape.
const OccupancyLevel& level_to_search(const OccupancyPyramid& pyramid) {
  std::size_t i = 0;
  while (i + 1 < pyramid.levels.size() && pyramid.levels[i + 1].resolution_m() <= kCoarsestSearch_m) ++i;
  return pyramid.levels[i];
}

/// What a pose that is not held by the map may be off by.
const Eigen::Matrix3d kWeakCovariance = Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal();
const Eigen::Matrix3d kLostCovariance = Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal();

}  // namespace

Result<HectorSlam> HectorSlam::make(const HectorSlamConfig& config, const Pose2& map_from_base) {
  if (const auto checked = check_config(config); !checked) return checked.error();
  if (!map_from_base.is_finite() || map_from_base.translation().cwiseAbs().maxCoeff() > kFarthest_m)
    return Error{"start pose", "it is not finite or beyond 1e5 m", "the origin will do"};
  return HectorSlam(config, map_from_base);
}

HectorSlam::HectorSlam(const HectorSlamConfig& config, const Pose2& map_from_base)
    : config_(config),
      laser_from_base_(config.base_from_laser.inverse()),
      map_(config.map),
      motion_([&] {
        MotionConfig motion = config.motion;
        motion.start_sigma_m = 0.0;  // the start is where it is said to be: it makes the map's frame
        motion.start_sigma_deg = 0.0;
        return motion;
      }()),
      judge_(config.judge) {
  motion_.start_at(map_from_base);
  last_.map_from_base = map_from_base;
  last_.reason = "no scan hit anything yet";
}

PoseEstimate HectorSlam::update(const Event& event) {
  if (const auto* odometry = std::get_if<Odometry>(&event))
    if (odometry->odom_from_base.is_finite()) odom_from_base_ = odometry->odom_from_base;
  const auto* scan = std::get_if<Scan>(&event);
  if (scan == nullptr) {
    PoseEstimate estimate = last_;
    estimate.stamp = stamp_of(event);
    if (!map_.empty()) {
      estimate.status = Status::not_a_scan;
      estimate.reason = "the event brought no scan";
    }
    return estimate;
  }
  // 1. What the laser saw. The first such scan begins the map.
  load(*scan);
  if (map_.empty()) return last_ = begin(*scan);
  // 2. Where the robot should be, and the match from there.
  const Prediction prediction = predict(scan->stamp());
  const SlamReach reach = reach_at(scan->stamp());
  SlamFit fit = fit_from(prediction.map_from_base * config_.base_from_laser);
  // 3. Where that is hard to believe, look around.
  if (is_worth_searching(worth(fit, prediction, reach), fit)) fit = search(fit, prediction, reach);
  // 4. Take it for the pose, or go on by the motion alone.
  const std::string_view doubt = judge_.reason_not_held(fit, worth(fit, prediction, reach));
  const bool is_held = doubt.empty();
  last_ =
      is_held ? accept(fit, prediction, reach, scan->stamp()) : coast(fit, prediction, scan->stamp(), doubt);
  odom_of_last_scan_ = odom_from_base_;
  // 5. Draw what was seen once the robot has moved.
  if (is_held && !draw_if_moved(*scan)) {
    last_.status = Status::degraded;
    last_.reason = "the map has as many cells as it may; what is new is not drawn (map.max_cells)";
  }
  return last_;
}

void HectorSlam::load(const Scan& scan) {
  points_.clear();
  for (std::size_t beam = 0; beam < scan.size(); ++beam)
    if (scan.is_hit(beam) && static_cast<double>(scan.ranges_m()[beam]) <= config_.beams.max_range_m)
      points_.push_back(scan.point(beam));
}

PoseEstimate HectorSlam::begin(const Scan& scan) {
  PoseEstimate estimate = last_;
  estimate.stamp = scan.stamp();
  if (points_.size() < static_cast<std::size_t>(config_.match.min_pairs)) return estimate;
  const Pose2 map_from_laser = last_.map_from_base * config_.base_from_laser;
  beam_ways(scan, map_from_laser, config_.beams, ways_);
  if (!map_.add(map_from_laser.translation(), ways_)) {
    estimate.reason = "the first scan needs more cells than the map may have (map.max_cells)";
    return estimate;
  }
  drawn_at_ = last_.map_from_base;
  held_at_ = scan.stamp();
  odom_of_last_scan_ = odom_from_base_;
  estimate.covariance = Eigen::Matrix3d::Zero();
  estimate.status = Status::ok;
  estimate.reason = "";
  estimate.quality = 1.0;
  motion_.correct(scan.stamp(), estimate.map_from_base, estimate.covariance);
  return estimate;
}

Prediction HectorSlam::predict(Stamp stamp) const {
  Prediction prediction = motion_.predict(stamp);
  if (config_.guess == SlamGuess::last_pose) prediction.map_from_base = last_.map_from_base;
  if (config_.guess == SlamGuess::odometry && odom_from_base_ && odom_of_last_scan_)
    prediction.map_from_base = last_.map_from_base * (odom_of_last_scan_->inverse() * *odom_from_base_);
  return prediction;
}

/// How far the robot may be from the prediction, after so long without a fit that held.
SlamReach HectorSlam::reach_at(Stamp stamp) const {
  const double elapsed_s = std::max(0.0, seconds_between(held_at_, stamp));
  const double move_m = config_.speed_mps * elapsed_s;
  const double turn_deg = config_.turn_degps * elapsed_s;
  SlamReach reach;
  reach.near_m = std::clamp(move_m, reach.near_m, std::max(reach.near_m, config_.search.window_m));
  reach.near_deg = std::clamp(turn_deg, reach.near_deg, std::max(reach.near_deg, config_.search.window_deg));
  reach.far_m = std::max({reach.near_m, config_.search.window_m, std::min(move_m, kWidest_m)});
  reach.far_deg = std::max({reach.near_deg, config_.search.window_deg, std::min(turn_deg, 180.0)});
  return reach;
}

SlamFit HectorSlam::fit_from(const Pose2& map_from_laser) {
  SlamFit fit;
  fit.match = match_hector(points_, map_.pyramid(), map_from_laser, config_.match, match_scratch_);
  fit.overlap = overlap_of(points_, map_.pyramid().levels.front(), fit.match.map_from_laser);
  return fit;
}

Pose2 HectorSlam::correction(const SlamFit& fit, const Prediction& prediction) const {
  return prediction.map_from_base.inverse() * (fit.match.map_from_laser * laser_from_base_);
}

double HectorSlam::worth(const SlamFit& fit, const Prediction& prediction, const SlamReach& reach) const {
  return judge_.worth(fit, correction(fit, prediction), reach);
}

bool HectorSlam::is_worth_searching(double worth, const SlamFit& fit) const {
  if (points_.size() < static_cast<std::size_t>(config_.match.min_pairs)) return false;
  if (config_.search_when != SlamSearch::in_doubt) return config_.search_when == SlamSearch::always;
  if (last_.status == Status::lost && not_held_in_a_row_ % kSearchStride != 0) return false;
  return worth == FitJudge::kWorthless || judge_.is_in_doubt(fit);
}

SlamFit HectorSlam::search(const SlamFit& first, const Prediction& prediction, const SlamReach& reach) {
  PyramidSearchConfig window = config_.search;
  window.window_m = reach.far_m;
  window.window_deg = reach.far_deg;
  search_pyramid(points_, level_to_search(map_.pyramid()), prediction.map_from_base * config_.base_from_laser,
                 window, search_scratch_, found_);
  found_.push_back({last_.map_from_base * config_.base_from_laser, 0.0});  // where HectorSLAM starts
  SlamFit best = first;
  double to_beat = worth(first, prediction, reach) + kClearlyBetter;
  for (const FoundPose& start : found_) {
    const SlamFit other = fit_from(start.map_from_laser);
    const double worth_of_other = worth(other, prediction, reach);
    if (worth_of_other <= to_beat) continue;
    best = other;
    to_beat = worth_of_other;
  }
  return best;
}

PoseEstimate HectorSlam::accept(const SlamFit& fit, const Prediction& prediction, const SlamReach& reach,
                                Stamp stamp) {
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_from_base = fit.match.map_from_laser * laser_from_base_;
  estimate.covariance = moved_covariance(fit.match.covariance, fit.match.map_from_laser, laser_from_base_);
  estimate.quality = fit.overlap.on_ratio;
  estimate.status = Status::ok;
  estimate.reason = "";
  if (fit.match.rank < 3) {
    estimate.covariance = fused_covariance(estimate.covariance, prediction.covariance);
    estimate.status = Status::degraded;
    estimate.reason = "the walls in view leave a direction open, which is held at the prediction";
  }
  estimate.covariance = symmetric(estimate.covariance);
  const bool is_surprising = judge_.is_surprising(fit, correction(fit, prediction), reach);
  if (is_surprising || judge_.contradicts(fit)) {
    estimate.covariance += kWeakCovariance;
    estimate.status = Status::degraded;
    estimate.reason = is_surprising ? "the scan fits away from the predicted pose, and much of it is new"
                                    : "part of the scan contradicts the map, more than is usual";
  }
  not_held_in_a_row_ = 0;
  held_at_ = stamp;
  judge_.learn(fit);
  if (fit.match.rank < 3)
    motion_.hold(stamp, estimate.map_from_base, estimate.covariance);
  else
    motion_.correct(stamp, estimate.map_from_base, estimate.covariance);
  return estimate;
}

PoseEstimate HectorSlam::coast(const SlamFit& fit, const Prediction& prediction, Stamp stamp,
                               std::string_view reason) {
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_from_base = prediction.map_from_base;
  ++not_held_in_a_row_;
  const bool is_lost = not_held_in_a_row_ >= config_.lost_after_scans;
  estimate.covariance = symmetric(prediction.covariance + (is_lost ? kLostCovariance : kWeakCovariance));
  estimate.status = is_lost ? Status::lost : Status::degraded;
  estimate.reason = reason;
  estimate.quality = fit.overlap.on_ratio;
  return estimate;
}

bool HectorSlam::draw_if_moved(const Scan& scan) {
  const Pose2& map_from_base = last_.map_from_base;
  if (distance_m(map_from_base, drawn_at_) < config_.update_distance_m &&
      heading_difference_rad(map_from_base, drawn_at_) < config_.update_angle_rad)
    return true;
  const Pose2 map_from_laser = map_from_base * config_.base_from_laser;
  beam_ways(scan, map_from_laser, config_.beams, ways_);
  if (!map_.add(map_from_laser.translation(), ways_)) return false;
  drawn_at_ = map_from_base;
  return true;
}

}  // namespace beaconless
