// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::trust {

constexpr double kWrong_m = 0.10;
constexpr double kWrong_rad = radians(2.0);
constexpr double kSureQuality = 0.5;  // an ok pose of this quality or more says that it deserves trust

/// What a localizer said of one scan, beside the truth.
struct ScanRecord {
  PoseEstimate estimate;
  Pose2 truth;
  bool is_right = false;  ///< within kWrong_m and kWrong_rad, and what the reference itself may be off
  std::optional<double> explained;  ///< share of the beams that end where the map says, where told …
  std::optional<double> explained_at_truth;  ///< … and from the true pose, where there is one

  double error_m() const { return distance_m(estimate.map_from_base, truth); }
  double error_rad() const { return heading_difference_rad(estimate.map_from_base, truth); }
  bool is_sure() const { return estimate.ok() && estimate.quality >= kSureQuality; }

  /// No look at this scan alone could have told that the pose is wrong: the map explains it as well from
  /// there as from the true pose, or, where there is none, for nine tenths.
  bool looks_right() const {
    constexpr double kAlike = 0.03;
    constexpr double kMost = 0.9;
    return explained && *explained >= (explained_at_truth ? *explained_at_truth - kAlike : kMost);
  }
};

}  // namespace beaconless::trust
