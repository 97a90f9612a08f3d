// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "beaconless/geometry/pose2.hpp"
#include "beaconless/track/motion_filter.hpp"

namespace beaconless {

/// How a robot moves while it is looked for: as the wheels tell, else as the likeliest place told by the
/// scans before; it stands as long as neither tells.
///
/// The motion is of the base, in its frame. Allocates nothing.
class SearchMotion {
 public:
  explicit SearchMotion(const Pose2& base_from_laser)
      : base_from_laser_(base_from_laser), laser_from_base_(base_from_laser.inverse()) {}

  /// Forgets how it moved.
  void begin() {
    found_.reset();
    is_unknown_ = false;
  }

  /// Takes in what the wheels tell of the time since the scan before. True where the motion has just become
  /// known, so that scans were seen without it.
  bool expect(const std::optional<ToldTwist>& by_wheels);

  const ToldTwist& motion() const { return motion_; }

  /// How the laser has moved (last_from_now) in so many seconds, where that is known.
  std::optional<Pose2> way(double seconds) const;

  /// Hears how the laser moved (before_from_now) since the scan before, `seconds` ago, as a place tells it.
  void hear(const std::optional<Pose2>& moved, double seconds);

 private:
  Pose2 base_from_laser_;
  Pose2 laser_from_base_;
  ToldTwist motion_;
  std::optional<ToldTwist> found_;  // by the places
  bool is_unknown_ = false;
};

}  // namespace beaconless
