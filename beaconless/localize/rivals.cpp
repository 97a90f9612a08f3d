// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/rivals.hpp"

#include <algorithm>

namespace beaconless {
namespace {

constexpr double kElsewhere_m = 0.2;
constexpr double kElsewhere_rad = radians(5.0);
constexpr double kAsGood = 1.4;  // times the misfit, and …
constexpr double kAsGoodMore = 0.02;

}  // namespace

void Rivals::clear() {
  tried_.clear();
  places_.clear();
}

bool Rivals::is_elsewhere(const Pose2& a, const Pose2& b) {
  return distance_m(a, b) > kElsewhere_m || heading_difference_rad(a, b) > kElsewhere_rad;
}

bool Rivals::is_as_good(const MatchResult& a, const MatchResult& b) {
  return a.misfit < kAsGood * b.misfit + kAsGoodMore;
}

void Rivals::look(const MatchResult& taken) {
  places_.clear();
  for (const MatchResult& other : tried_) {
    const Pose2& place = other.map_from_laser;
    if (!other.usable() || !is_as_good(other, taken) || !is_elsewhere(place, taken.map_from_laser)) continue;
    const bool is_known = std::any_of(places_.begin(), places_.end(),
                                      [&](const Pose2& known) { return !is_elsewhere(place, known); });
    if (!is_known) places_.push_back(place);
  }
}

Eigen::Matrix3d Rivals::covariance(const Pose2& map_from_base, const Pose2& laser_from_base) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Pose2& place : places_) {
    const Pose2 other = place * laser_from_base;
    const Eigen::Vector3d way(other.x_m - map_from_base.x_m, other.y_m - map_from_base.y_m,
                              wrap_angle(other.theta_rad - map_from_base.theta_rad));
    sum += way * way.transpose();
  }
  return sum;
}

}  // namespace beaconless
