// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/raw_scan.hpp"
#include "beaconless/sim/world.hpp"

namespace beaconless::sim {

/// When the beams of a sweep are measured.
enum class Sweep : int {
  rotating,       ///< one after the other, as the mirror turns: a moving robot sees a bent room
  instantaneous,  ///< all at the stamp
};

/// A 2-D laser scanner. The defaults are Hokuyo's UTM-30LX.
///
/// Source: the dissertation's Table 4.1 and the maker's data sheet (repeatability below 10 mm up to 10 m).
struct LidarConfig {
  int beam_count = 1081;
  double angle_min_deg = -135.0;
  double angle_max_deg = 135.0;  ///< of the last beam: 1081 beams are 1080 steps of 0.25 deg
  double rate_hz = 40.0;         ///< turns of the mirror; one sweep a turn
  Sweep sweep = Sweep::rotating;
  double range_min_m = 0.1;
  double range_max_m = 30.0;
  double range_sigma_m = 0.01;
  double range_step_m = 0.001;
  double mixed_pixel_share = 0.0;
  double dropout_share = 0.0;

  double angle_step_rad() const;

  /// Seconds from one beam to the next; 0 when all are measured at once.
  double beam_time_s() const;

  friend bool operator==(const LidarConfig&, const LidarConfig&) = default;
};

void describe(Fields& fields, LidarConfig& config);

/// Where the laser is at a moment, in seconds since the scenario began.
using LaserMotion = std::function<Pose2(double time_s)>;

/// Measures one sweep whose first beam is at `time_s`; the stamp is that moment.
///
/// Each range is exact, plus Gaussian noise, rounded to the range step; then +inf where nothing was met
/// within range_max_m and -inf below range_min_m (REP 117). Bearings are those that the scan's own floats
/// tell. A mixed pixel is a beam at an edge (half a step to its left and right lie depths more than 0.1 m and
/// ten sigma apart) that measures a point between the two.
///
/// In: `rng` makes the noise; faults draw from a fork of it, so that they change no other beam.
/// Cost: a ray through the world per beam; three for the beams that may be mixed pixels.
RawScan measure_sweep(const World& world, const LidarConfig& config, const LaserMotion& map_from_laser,
                      double time_s, Rng& rng);

}  // namespace beaconless::sim
