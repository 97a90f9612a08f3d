// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "beaconless/core/describe.hpp"
#include "beaconless/features/four_floats.hpp"

namespace beaconless {

/// How large the neighbourhood of a point is that a beam of some range hit: a exp(b range).
///
/// Far points lie further apart, so the radius grows with range. It is never more than 0.8 of the range.
/// Source: Kallasi, Lodi Rizzini and Caselli 2016, section III-A; dissertation Table 4.10 (neighA, neighB).
struct KeypointRadius {
  double at_zero_m = 0.1;      ///< a
  double growth_per_m = 0.07;  ///< b

  /// For four ranges at once, each not above 1000 m; 0 for 0.
  Floats4 at(const Floats4& range_m) const {
    constexpr float kMostExponent = 80.0F;
    const Floats4 exponent = static_cast<float>(growth_per_m) * range_m;
    const Floats4 radius =
        static_cast<float>(at_zero_m) * exp4(where(exponent < kMostExponent, exponent) +
                                             where(exponent >= kMostExponent, Floats4{} + kMostExponent));
    const Ints4 fits = radius < range_m;
    return where(fits, radius) + where(~fits, 0.8F * range_m);
  }
  float at(float range_m) const { return at(Floats4{} + range_m)[0]; }

  friend bool operator==(const KeypointRadius&, const KeypointRadius&) = default;
};

inline void describe(Fields& fields, KeypointRadius& radius) {
  fields("at_zero_m", radius.at_zero_m, {0.001, 10.0}, "radius of the neighbourhood close to the scanner");
  fields("growth_per_m", radius.growth_per_m, {0.0, 1.0}, "exponent by which it grows with range");
}

/// No point within `radius_m` of a point at `range_m` is more beams away from it than this; not many more
/// than needed. Radii beyond 0.8 of the range count as 0.8.
inline std::int32_t beams_within(float radius_m, float range_m, float beams_per_rad) {
  const float sine = std::min(radius_m / range_m, 0.8F);
  // asin(s) <= s (1 + s²/4) up to 0.8, and this needs no root
  return static_cast<std::int32_t>(sine * (1.0F + 0.25F * sine * sine) * beams_per_rad) + 1;
}

/// The most beams that beams_within() gives.
inline std::size_t most_beams_within(float beams_per_rad) {
  return static_cast<std::size_t>(beams_within(1.0F, 1.0F, beams_per_rad));
}

}  // namespace beaconless
