// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/rivals.hpp"

#include <algorithm>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {
namespace {

constexpr double kElsewhere_m = 0.2;
constexpr double kElsewhere_rad = radians(5.0);
constexpr double kAsGood = 1.4;  // times the misfit, and …
constexpr double kAsGoodMore = 0.02;
constexpr int kGoneAfter = 8;  // scans in a row that fit a place worse

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
    const bool is_known = std::any_of(places_.begin(), places_.end(), [&](const Place& known) {
      return !is_elsewhere(place, known.map_from_laser);
    });
    if (!is_known) places_.push_back({place});
  }
}

void Rivals::drop_known(const Pose2& taken) {
  std::size_t kept = 0;
  for (const Place& place : places_) {
    const bool is_gone = place.worse_scans >= kGoneAfter || !is_elsewhere(place.map_from_laser, taken);
    const bool is_known = std::any_of(
        places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(kept),
        [&](const Place& known) { return !is_elsewhere(place.map_from_laser, known.map_from_laser); });
    if (!is_gone && !is_known) places_[kept++] = place;
  }
  places_.resize(kept);
}

Eigen::Matrix3d Rivals::covariance(const Pose2& map_from_base, const Pose2& laser_from_base) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Place& place : places_) {
    const Eigen::Vector3d way = way_between(map_from_base, place.map_from_laser * laser_from_base);
    sum += way * way.transpose();
  }
  return sum;
}

}  // namespace beaconless
