// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/describe.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {

/// How far a pose may be off, however unluckily: a radius and an angle that are exceeded in one scan of very
/// many. Begins knowing nothing.
struct ProtectionLevel {
  static constexpr double kUnbounded_m = 1e3;

  double position_m = kUnbounded_m;
  double heading_rad = kPi;

  bool is_bounded() const { return position_m < kUnbounded_m; }

  friend bool operator==(const ProtectionLevel&, const ProtectionLevel&) = default;
};

/// What a protection level is to hold against.
struct ProtectionConfig {
  double risk = 1e-4;     ///< the share of scans whose error may be larger
  double bias_m = 0.002;  ///< what all beams of one wall are off by alike, as the laser measures it
};

void describe(Fields& fields, ProtectionConfig& config);

/// How many standard deviations an error in the plane exceeds with a given probability: its radius, and so
/// much the more one component of it, is beyond K sigma with exp(-K²/2).
double protection_sigmas(double risk);

}  // namespace beaconless
