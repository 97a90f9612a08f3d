// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/search_motion.hpp"

#include <cmath>
#include <utility>

namespace beaconless {
namespace {

constexpr double kFastest_m_per_s = 5.0;  // of a robot; what is faster is a place that was not held
constexpr double kFastest_rad_per_s = 5.0;

}  // namespace

bool SearchMotion::expect(const std::optional<ToldTwist>& by_wheels) {
  motion_ = by_wheels ? *by_wheels : found_.value_or(ToldTwist{});
  const bool was_unknown = std::exchange(is_unknown_, !by_wheels && !found_);
  return was_unknown && !is_unknown_;
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
  const Eigen::Vector3d per_s = way.vector() / seconds;
  if (per_s.head<2>().norm() > kFastest_m_per_s || std::abs(per_s.z()) > kFastest_rad_per_s) return;
  found_ = ToldTwist{per_s, Eigen::Matrix3d::Zero()};
}

}  // namespace beaconless
