// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/match/protection_level.hpp"

namespace beaconless {

/// How a match ended.
enum class MatchStatus {
  not_run,
  converged,
  max_iterations,  ///< still moving when told to stop; the pose is the best one met
  too_few_pairs,   ///< nothing to hold on to; the pose is the guess
};

constexpr std::string_view to_string(MatchStatus status) {
  switch (status) {
    case MatchStatus::not_run:
      return "not run";
    case MatchStatus::converged:
      return "converged";
    case MatchStatus::max_iterations:
      return "still moving after the last iteration";
    case MatchStatus::too_few_pairs:
      return "too few pairs";
  }
  return "unknown";
}

/// A pose found from a scan and a map, with what it is worth. Begins pessimistic.
///
/// `covariance` is of (x, y, theta) of the laser, x and y along the map axes. A direction
/// that the scan does not determine (along a corridor, heading in a round room) is left at the guess and not
/// counted in `rank`; the covariance there is kUnknownSigma².
struct MatchResult {
  static constexpr double kUnknownSigma = 1e3;

  Pose2 map_from_laser;
  Eigen::Matrix3d covariance = kUnknownSigma * kUnknownSigma * Eigen::Matrix3d::Identity();
  MatchStatus status = MatchStatus::not_run;
  int rank = 0;                                              ///< directions determined, 0 … 3
  Eigen::Vector3d weak_direction = Eigen::Vector3d::Zero();  ///< unit (m, m, rad); the least determined one
  int iterations = 0;
  int pair_count = 0;
  double scale_m = 0.0;       ///< the robust standard deviation of residuals that weights were made with
  double on_map_ratio = 0.0;  ///< share of the scan's points that lie on the map (see IcpConfig::on_map_m)
  double misfit = 1.0;  ///< mean squared distance to the map, in units of on_map_m and at most 1 a point
  ProtectionLevel protection;  ///< of map_from_laser; unbounded where the method tells none

  bool usable() const { return status == MatchStatus::converged || status == MatchStatus::max_iterations; }
};

}  // namespace beaconless
