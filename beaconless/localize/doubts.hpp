// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// What a pose of (x, y, theta) may be off by that rests on a weak fit: a cell or two.
inline const Eigen::Matrix3d kWeakCovariance = Eigen::Vector3d(0.01, 0.01, 0.0025).asDiagonal();
/// … and where the robot is lost: the whole window that is searched.
inline const Eigen::Matrix3d kLostCovariance = Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal();

inline constexpr std::string_view kFound = "a place that fits was found; more scans must agree";
inline constexpr std::string_view kCovered =
    "the scanner seems to be covered: hardly a beam comes from further than half a metre";

/// Why Health judged so; "" where it is ok. Static text.
constexpr std::string_view reason_of(Status status, bool was_lost) {
  if (status == Status::ok) return "";
  if (status == Status::lost) return "the scan does not fit the map here";
  return was_lost ? kFound : "less of the scan lies on the map than is usual";
}

}  // namespace beaconless
