// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/laser_fix.hpp"

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {

void LaserFix::start_at(const Pose2& map_from_base) {
  motion_.start_at(map_from_base);
  stamp_.reset();
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
  ToldTwist motion = motion_.motion_at(stamp);
  // The poses that told this velocity are off together with it: the two errors may add up in full.
  double together = 2.0;
  if (odometry_.is_trusted())
    if (const auto told = dt > 0.0 ? odometry_.between(*stamp_, stamp) : odometry_.between(stamp, *stamp_)) {
      motion = *told;
      together = 1.0;
    }
  const Eigen::Vector3d way = dt * motion.per_s;
  const Pose2 step = Pose2::exp({way.x(), way.y(), way.z()});
  const Eigen::Matrix3d to_map = turn_of(last_.pose);
  const Eigen::Matrix3d moved = dt * dt * to_map * motion.covariance * to_map.transpose();
  const double factor = dt == 0.0 ? 1.0 : together;
  return {last_.pose * step,
          symmetric(factor * (moved_covariance(last_.covariance, last_.pose, step) + moved))};
}

}  // namespace beaconless
