// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "beaconless/core/stamp.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless {

/// Tells when the place of a robot that is followed comes into doubt: it may have been carried off, and what
/// fits near by need not be where it is.
///
/// Doubt comes of scans that stop fitting, of a place lost and found again, of a jump, and of beams that have
/// passed through walls for a while. Allocates nothing.
class Shaken {
 public:
  void forget() { *this = Shaken(); }

  void see_fit(Status status, bool was_lost);  ///< a scan was fitted, and that judged so
  void see_jump() { is_shaken_ = true; }       ///< … somewhere else than any motion explains
  /// A scan was not fitted; whether it lies on the map where the robot should be all the same: then only the
  /// method found too little, and nothing is in doubt.
  void see_none(bool is_explained);

  /// Whether the last scans fitted nowhere, but too few of them to say anything.
  bool is_blinded() const { return unfitted_scans_ > 0 && unfitted_scans_ < kShaking; }
  /// Whether the last scan was fitted well.
  bool is_fitted() const { return unfitted_scans_ == 0 && !is_weak_; }

  /// Whether there is a new doubt since this was asked last. In: whether beams pass through walls now. Where
  /// doubts follow each other, as among people, they are given ever more rarely.
  bool take(Stamp stamp, bool is_through_walls);

 private:
  static constexpr int kShaking = 2;  // so many scans in a row that fit nowhere

  bool is_long_through_walls(Stamp stamp, bool is_through_walls);

  bool is_shaken_ = false;
  int unfitted_scans_ = 0;    // in a row
  bool is_weak_ = false;      // the last fit explains little
  bool is_weakened_ = false;  // the same by less: a fit has just begun to explain little
  std::optional<Stamp> through_since_;
  std::optional<Stamp> taken_;
  double pause_s_ = 0.0;  // after the last one was taken
};

}  // namespace beaconless
