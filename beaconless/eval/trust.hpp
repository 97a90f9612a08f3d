// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "beaconless/geometry/trajectory.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::eval {

/// A pose of this quality or more asks to be trusted.
inline constexpr double kTrusted_quality = PoseEstimate::kTrusted_quality;
/// A pose that is further off than either of these did not deserve it.
inline constexpr double kTrusted_m = 0.1;
inline constexpr double kTrusted_deg = 2.0;

/// What an estimate said of itself, and how far off it was.
struct JudgedEstimate {
  Stamp stamp;
  Status status = Status::ok;
  double quality = 0.0;
  double protection_m = PoseEstimate::kUnbounded_m;
  double protection_rad = kPi;
  double position_error_m = 0.0;
  double heading_error_rad = 0.0;  ///< absolute

  bool is_trusted() const { return status == Status::ok && quality >= kTrusted_quality; }
  bool is_near() const {
    return position_error_m <= kTrusted_m && heading_error_rad <= radians(kTrusted_deg);
  }
  bool is_bounded() const { return protection_m < PoseEstimate::kUnbounded_m || protection_rad < kPi; }
  bool is_beyond_protection() const {
    return position_error_m > protection_m || heading_error_rad > protection_rad;
  }

  friend bool operator==(const JudgedEstimate&, const JudgedEstimate&) = default;
};

/// The estimates that tell a pose (ok, degraded, lost) and have a truth at their stamp.
std::vector<JudgedEstimate> judge_estimates(std::span<const PoseEstimate> estimates, const Trajectory& truth,
                                            double max_gap_s = 1.0);

/// The poses of a range of qualities.
struct QualityBin {
  double low = 0.0;
  double high = 0.0;  ///< below it; the last one's 1 belongs to it
  std::size_t count = 0;
  std::size_t near_count = 0;  ///< of them within kTrusted_m and kTrusted_deg

  friend bool operator==(const QualityBin&, const QualityBin&) = default;
};

/// Whether the estimates can be believed about themselves.
struct Trust {
  std::size_t trusted_count = 0;    ///< ok, of kTrusted_quality or more
  std::size_t false_ok_count = 0;   ///< of them, those that are not near
  std::size_t bounded_count = 0;    ///< ok or degraded, with a protection level
  std::size_t violation_count = 0;  ///< of them, those whose error is larger
  std::vector<QualityBin> bins;     ///< ten, from 0 to 1

  /// 0 for none.
  double false_ok_ratio() const;
  double violation_ratio() const;
};

Trust trust_of(std::span<const JudgedEstimate> estimates);

}  // namespace beaconless::eval
