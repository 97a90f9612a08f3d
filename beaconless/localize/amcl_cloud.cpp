// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/amcl_cloud.hpp"

#include <cmath>
#include <utility>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/localize/lost_window.hpp"

namespace beaconless {
namespace {

constexpr double kOnePlace = 0.95;  // of all weight, in one cluster
constexpr double kWide_m = 0.3;     // a cloud wider than either in some direction tells no pose
constexpr double kWide_rad = radians(10.0);
constexpr double kTypicalArm_m = 3.0;  // at which what is known across becomes a heading

double square(double value) { return value * value; }

}  // namespace

AmclCloud::AmclCloud(const LocalizerConfig& config, const Map& map,
                     std::shared_ptr<const SurfaceMap> surfaces)
    : config_(config),
      map_(std::move(surfaces)),
      nearness_(*map_, config.search.cell_m, config.search.truncate_m),
      filter_(map, *map_, config.base_from_laser, config.amcl) {}

void AmclCloud::begin(const Belief& belief) {
  at_update_ = belief;
  now_ = belief;
  since_ = {};
  hints_.clear();
  heaviest_ = 0.0;
  is_blind_ = false;
}

void AmclCloud::start_at(const Pose2& map_from_base) {
  const double sigma_rad = radians(config_.motion.start_sigma_deg);
  const Eigen::Matrix3d covariance = Eigen::Vector3d(square(config_.motion.start_sigma_m),
                                                     square(config_.motion.start_sigma_m), square(sigma_rad))
                                         .asDiagonal();
  filter_.start_at(map_from_base, covariance);
  begin({map_from_base, covariance});
}

void AmclCloud::start_anywhere(const std::optional<SearchRegion>& within) {
  if (within)
    filter_.start_within(within->middle, within->radius_m);
  else
    filter_.start_anywhere();
  const Pose2& mean = clusters().front().mean;
  begin({mean, spread_around(mean, clusters())});
}

void AmclCloud::carry(const Step& step) {
  if (step.is_by_wheels) {
    since_ = since_ * step.motion;
    const OdometryStep so_far = odometry_step(since_, config_.amcl);
    now_ = {at_update_.map_from_base * since_,
            moved_by_odometry(at_update_.covariance, at_update_.map_from_base, so_far)};
    return;
  }
  if (since_ != Pose2{}) filter_.move(odometry_step(std::exchange(since_, {}), config_.amcl));
  filter_.move(step.motion, step.covariance);
  const Eigen::Matrix3d turn = turn_of(now_.map_from_base);
  now_ = {now_.map_from_base * step.motion, now_.covariance + turn * step.covariance * turn.transpose()};
  at_update_ = now_;
}

bool AmclCloud::is_due(const Step& step) const {
  return !step.is_by_wheels || std::hypot(since_.x_m, since_.y_m) >= config_.amcl.update_min_d ||
         std::abs(since_.theta_rad) >= config_.amcl.update_min_a;
}

void AmclCloud::weigh(const Scan& scan, std::span<const Eigen::Vector2d> points, bool is_lost) {
  if (since_ != Pose2{}) filter_.move(odometry_step(std::exchange(since_, {}), config_.amcl));
  at_update_ = now_;
  is_blind_ = !filter_.weigh(scan, points);
  if (is_blind_) return;
  heaviest_ = clusters().front().weight;
  at_update_ = {clusters().front().mean, spread_around(clusters().front().mean, clusters())};
  // However narrow the cloud is, it knows walls by the cells of its field.
  const double cell_m2 = square(config_.amcl.laser_field_cell) / 12.0;
  at_update_.covariance.diagonal() += Eigen::Vector3d(cell_m2, cell_m2, cell_m2 / square(kTypicalArm_m));
  now_ = at_update_;
  search_where_lost(points, is_lost);
  // What is new to the map lowers weights too; where the rest of the scan fits, nothing is put elsewhere.
  filter_.resample(is_lost, hints_);
}

void AmclCloud::search_where_lost(std::span<const Eigen::Vector2d> points, bool is_lost) {
  hints_.clear();
  if (!(is_lost && filter_.lost_share() > 0.0)) {
    lost_scans_ = 0;
    return;
  }
  if (lost_scans_++ % config_.search.lost_stride != 0) return;
  search_around(points, nearness_, now_.map_from_base * config_.base_from_laser, lost_window(config_.search),
                search_scratch_, starts_);
  const Pose2 laser_from_base = config_.base_from_laser.inverse();
  for (const StartPose& start : starts_) hints_.push_back(start.map_from_laser * laser_from_base);
}

bool AmclCloud::is_one_place() const { return heaviest_ >= kOnePlace; }

bool AmclCloud::is_wide() const {
  const Eigen::Matrix3d& covariance = now_.covariance;
  return covariance(0, 0) > square(kWide_m) || covariance(1, 1) > square(kWide_m) ||
         covariance(2, 2) > square(kWide_rad);
}

}  // namespace beaconless
