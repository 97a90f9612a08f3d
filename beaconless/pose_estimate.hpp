// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless {

/// The plain word that goes with every pose.
enum class Status : int {
  not_started,   ///< no start pose was given yet
  not_a_scan,    ///< the event brought no scan; the last pose is repeated
  ok,            ///< the pose can be trusted to its covariance
  degraded,      ///< a direction is unobservable or the fit is weak: the pose coasts there on its prediction
  lost,          ///< the scans no longer fit the map where the robot is believed to be
  relocalizing,  ///< it is being found: places of the map are known that fit, and more scans must tell which
};

constexpr std::string_view to_string(Status status) {
  switch (status) {
    case Status::not_started:
      return "not_started";
    case Status::not_a_scan:
      return "not_a_scan";
    case Status::ok:
      return "ok";
    case Status::degraded:
      return "degraded";
    case Status::lost:
      return "lost";
    case Status::relocalizing:
      return "relocalizing";
  }
  return "unknown";
}

/// Everything the robot learns from an event. The one way out.
///
/// All numbers are finite whatever came in. The covariance is ordered x, y, theta, in m², m·rad, rad², with x
/// and y along the map axes; its default says that nothing is known.
struct PoseEstimate {
  Stamp stamp;
  Pose2 map_from_base;
  Eigen::Matrix3d covariance = Eigen::Vector3d(1e6, 1e6, 10.0).asDiagonal();
  Status status = Status::not_started;
  std::string_view reason = "no start pose was given";  ///< why the status is not ok; static text, "" when ok
  double quality = 0.0;                                 ///< 0 … 1: how far the pose deserves trust

  /// A pose that is ok at this quality or more deserves it.
  static constexpr double kTrusted_quality = 0.5;

  /// Protection level: the true pose is meant to be within these but for one scan in ten thousand (how far
  /// that holds: docs/concepts/protection.md). At most kUnbounded and pi, which say that nothing bounds the
  /// error.
  static constexpr double kUnbounded_m = 1e3;
  double protection_m = kUnbounded_m;
  double protection_rad = kPi;

  bool jumped = false;  ///< the pose does not follow from the one before by any motion: the belief changed

  bool ok() const { return status == Status::ok; }
  bool is_trusted() const { return ok() && quality >= kTrusted_quality; }

  friend bool operator==(const PoseEstimate&, const PoseEstimate&) = default;
};

}  // namespace beaconless
