// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/way_check.hpp"

#include <algorithm>
#include <cmath>

namespace beaconless {
namespace {

constexpr double kStretch_m = 1.0;     // after which the ways are compared
constexpr double kParted_m = 0.15;     // far more than wheels slip on a stretch …
constexpr double kPartedShare = 0.15;  // … and of what they have driven
constexpr double kParted_rad = radians(15.0);
constexpr int kHeard = 2;  // agreeing stretches, and the wheels are heard

}  // namespace

void WayCheck::begin() {
  begun_ = false;
  agreed_ = 0;
}

void WayCheck::begin_stretch(Stamp stamp, const Pose2& map_from_base) {
  begun_ = true;
  last_ = stamp;
  from_ = map_from_base;
  by_wheels_ = Pose2{};
  driven_m_ = 0.0;
}

bool WayCheck::part(Stamp stamp, const Pose2& map_from_base, const OdometryTrack& odometry) {
  // 1. On by what the wheels tell; a gap begins anew.
  const auto told = begun_ ? odometry.between(last_, stamp) : std::nullopt;
  if (!told) {
    begin_stretch(stamp, map_from_base);
    return false;
  }
  const Eigen::Vector3d way = told->per_s * seconds_between(last_, stamp);
  by_wheels_ = by_wheels_ * Pose2::exp({way.x(), way.y(), way.z()});
  driven_m_ += way.head<2>().norm();
  last_ = stamp;
  // 2. After a stretch of either, how far the two ends are apart.
  const Pose2 by_poses = from_.inverse() * map_from_base;
  if (std::max(driven_m_, by_poses.translation().norm()) < kStretch_m) return false;
  const bool has_parted = distance_m(by_poses, by_wheels_) > kParted_m + kPartedShare * driven_m_ ||
                          heading_difference_rad(by_poses, by_wheels_) > kParted_rad;
  const bool is_heard = agreed_ >= kHeard;
  agreed_ = has_parted ? 0 : agreed_ + 1;
  begin_stretch(stamp, map_from_base);
  return has_parted && is_heard;
}

}  // namespace beaconless
