// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/trajectory.hpp"

#include <algorithm>

namespace beaconless {
namespace {

bool earlier(const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; }

}  // namespace

Trajectory::Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  std::stable_sort(poses_.begin(), poses_.end(), earlier);
}

void Trajectory::add(Stamp stamp, const Pose2& pose) {
  const StampedPose added{stamp, pose};
  poses_.insert(std::upper_bound(poses_.begin(), poses_.end(), added, earlier), added);
}

std::optional<Pose2> Trajectory::at(Stamp stamp, double max_gap_s) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), StampedPose{stamp, {}}, earlier);
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == poses_.begin()) return std::nullopt;
  const StampedPose& before = *(after - 1);
  const double gap_s = seconds_between(before.stamp, after->stamp);
  if (gap_s > max_gap_s) return std::nullopt;
  return interpolate(before.pose, after->pose, seconds_between(before.stamp, stamp) / gap_s);
}

double Trajectory::length_m() const {
  double length = 0.0;
  for (std::size_t i = 1; i < poses_.size(); ++i) length += distance_m(poses_[i - 1].pose, poses_[i].pose);
  return length;
}

}  // namespace beaconless
