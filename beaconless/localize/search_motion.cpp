// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/search_motion.hpp"

#include <utility>

namespace beaconless {

bool SearchMotion::expect(const std::optional<ToldTwist>& by_wheels) {
  motion_ = by_wheels ? *by_wheels : found_.value_or(ToldTwist{});
  const bool was_unknown = std::exchange(is_unknown_, !by_wheels && !found_);
  return found_ && was_unknown;
}

std::optional<Pose2> SearchMotion::way(double seconds) const {
  if (is_unknown_) return std::nullopt;
  const Eigen::Vector3d way = motion_.per_s * seconds;
  return laser_from_base_ * Pose2::exp(Twist2{way.x(), way.y(), way.z()}) * base_from_laser_;
}

void SearchMotion::hear(const std::optional<Pose2>& moved, double seconds) {
  found_.reset();
  if (!moved || !(seconds > 0.0)) return;
  const Twist2 way = (base_from_laser_ * *moved * laser_from_base_).log();
  found_ = ToldTwist{way.vector() / seconds, Eigen::Matrix3d::Zero()};
}

}  // namespace beaconless
