// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/laser_fix.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {
namespace {

constexpr double kTogether_s = 0.01;  // from then on the error of a velocity adds to that of the pose

}  // namespace

void LaserFix::start_at(const Pose2& map_from_base) {
  motion_.start_at(map_from_base);
  stamp_.reset();  // the wheels are those of the robot, wherever it is
}

void LaserFix::take(const PoseEstimate& estimate) {
  const Pose2& pose = estimate.map_from_base;
  if (estimate.jumped) start_at(pose);
  if (estimate.ok()) {
    const auto seen = motion_.told_by(estimate.stamp, pose, estimate.covariance);
    if (seen && stamp_) odometry_.compare(*stamp_, estimate.stamp, *seen);
    motion_.correct(estimate.stamp, pose, estimate.covariance);
  } else {
    motion_.hold(estimate.stamp, pose, estimate.covariance);
  }
  last_ = {pose, estimate.covariance};
  stamp_ = estimate.stamp;
}

PoseOpinion LaserFix::at(Stamp stamp) const {
  const double dt = seconds_between(*stamp_, stamp);
  const double apart_s = std::abs(dt);
  ToldTwist motion = motion_.motion_at(stamp);
  // The poses that told this velocity are off together with it: the two errors may add up in full.
  double together = 1.0 + std::min(1.0, apart_s / kTogether_s);
  if (odometry_.is_trusted()) {
    // Odometry may be set anew, too, and would carry the robot off.
    const auto told = dt > 0.0 ? odometry_.between(*stamp_, stamp) : odometry_.between(stamp, *stamp_);
    if (told && motion_.is_possible(*told, apart_s)) {
      motion = *told;
      together = 1.0;
    }
  }
  const Eigen::Vector3d way = dt * motion.per_s;
  const Pose2 step = Pose2::exp({way.x(), way.y(), way.z()});
  const Eigen::Matrix3d to_map = turn_of(last_.pose);
  const Eigen::Matrix3d moved = dt * dt * to_map * motion.covariance * to_map.transpose();
  return {last_.pose * step,
          symmetric(together * (moved_covariance(last_.covariance, last_.pose, step) + moved))};
}

}  // namespace beaconless
