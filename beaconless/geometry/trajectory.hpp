// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// Where something was at a moment.
struct StampedPose {
  Stamp stamp;
  Pose2 pose;

  friend bool operator==(const StampedPose&, const StampedPose&) = default;
};

/// Stamped poses in order of time; poses of equal stamps keep the order in which they came.
class Trajectory {
 public:
  Trajectory() = default;
  explicit Trajectory(std::vector<StampedPose> poses);

  /// Appends; a stamp older than the last is put where it belongs.
  void add(Stamp stamp, const Pose2& pose);

  /// The pose at a moment, along the constant twist between its two neighbours.
  ///
  /// Nothing before the first or after the last pose, nor where the neighbours are more than `max_gap_s`
  /// apart (a stamp that is in the trajectory always answers, the first of several equal ones). Cost: O(log
  /// n).
  std::optional<Pose2> at(Stamp stamp, double max_gap_s = 1.0) const;

  /// Metres along the poses.
  double length_m() const;

  bool empty() const { return poses_.empty(); }
  std::size_t size() const { return poses_.size(); }
  const StampedPose& front() const { return poses_.front(); }
  const StampedPose& back() const { return poses_.back(); }
  const StampedPose& operator[](std::size_t i) const { return poses_[i]; }
  auto begin() const { return poses_.begin(); }
  auto end() const { return poses_.end(); }
  friend bool operator==(const Trajectory&, const Trajectory&) = default;

 private:
  std::vector<StampedPose> poses_;
};

}  // namespace beaconless
