// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/stamp.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// How far wheels, or another dead reckoning, are believed.
struct OdometryConfig {
  bool use = true;            ///< where there is any; it is never needed
  double share = 0.05;        ///< of a speed that it is off by, standard deviation …
  double sigma_mps = 0.02;    ///< … and this much in any case
  double sigma_radps = 0.01;  ///< … of the rate of turn
};

void describe(Fields& fields, OdometryConfig& config);

/// The last seconds of an odometry, asked for the motion between two moments.
///
/// Odometry that has never moved tells nothing: logs without any have zeros there. What it tells is to be
/// believed only as long as it agrees with what is seen, because logs also hold odometry that somebody has
/// corrected, with jumps. Allocates nothing.
class OdometryTrack {
 public:
  explicit OdometryTrack(const OdometryConfig& config = {}) : config_(config) {}

  /// Takes in where the odometry thinks the base is. A stamp at or before the last one begins anew.
  void add(Stamp stamp, const Pose2& odom_from_base);

  /// The mean velocity between two moments; nothing where most of the time between them is not covered.
  std::optional<ToldTwist> between(Stamp from, Stamp to) const;

  /// Hears what the velocity was between two moments; from this trust is made or lost.
  void compare(Stamp from, Stamp to, const ToldTwist& seen);

  /// Whether it has agreed with what was seen for a while.
  bool is_trusted() const { return agreed_ >= kAgreed; }

  static constexpr int kAgreed = 5;  ///< in a row, to be trusted

 private:
  struct Entry {
    Stamp stamp;
    Pose2 odom_from_base;
  };
  static constexpr std::size_t kRoom = 256;  // a second of fast wheels, ten of slow ones

  const Entry& entry(std::size_t age) const { return entries_[(next_ + kRoom - 1 - age) % kRoom]; }
  Entry at(Stamp stamp) const;

  OdometryConfig config_;
  std::array<Entry, kRoom> entries_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  Pose2 begun_at_;
  bool has_moved_ = false;  // from there, ever
  int agreed_ = 0;          // scans in a row
};

}  // namespace beaconless
