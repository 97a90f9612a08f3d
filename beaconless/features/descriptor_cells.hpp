// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "beaconless/features/descriptor_neighbourhood.hpp"
#include "beaconless/features/keypoint.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// A polar grid around a keypoint, turned with it: `Rings` rings of equal width from inner_m to outer_m, each
/// of `Sectors` equal sectors. The cell of ring r and sector s is number r * Sectors + s.
///
/// Sector 0 begins at `phase_rad` counter-clockwise from the keypoint's orientation; every cell holds its
/// lower bounds and not its upper ones. A point outside is in cell kOutside. Sectors are told apart by
/// slopes, not by arc tangents, so that the loop over beams runs in vector registers.
template <int Sectors, int Rings>
class PolarCells {
 public:
  static_assert(Sectors % 4 == 0 && Sectors <= 32);
  static constexpr int kCount = Sectors * Rings;
  static constexpr int kOutside = kCount;
  static constexpr std::size_t kChunk = 64;
  using Codes = std::array<std::int32_t, kChunk>;

  PolarCells(const Keypoint& keypoint, double inner_m, double outer_m, double phase_rad)
      : x_(static_cast<float>(keypoint.point.x())),
        y_(static_cast<float>(keypoint.point.y())),
        cos_(static_cast<float>(std::cos(keypoint.orientation_rad + phase_rad))),
        sin_(static_cast<float>(std::sin(keypoint.orientation_rad + phase_rad))) {
    for (int r = 0; r <= Rings; ++r) {
      const double radius_m = inner_m + (outer_m - inner_m) * r / Rings;
      squares_[static_cast<std::size_t>(r)] = static_cast<float>(radius_m * radius_m);
    }
    for (int k = 1; k < Sectors / 4; ++k)
      slopes_[static_cast<std::size_t>(k)] = static_cast<float>(std::tan(2.0 * kPi * k / Sectors));
  }

  /// The cell of a point of the sensor frame.
  int cell(float x_m, float y_m) const { return code(1.0F, x_m, y_m); }

  /// The cells of the end points of `count` <= kChunk beams; what is no hit lies outside.
  void codes(const Scan& scan, std::size_t first, std::size_t count, Codes& out) const {
    const float* const range = scan.ranges_m().data() + first;
    const float* const x = scan.x_m().data() + first;
    const float* const y = scan.y_m().data() + first;
    for (std::size_t k = 0; k < count; ++k) out[k] = code(range[k], x[k], y[k]);
  }

  /// Calls `take(cell)` for every beam around the keypoint, with kOutside where it ends elsewhere.
  template <class Take>
  void for_each_hit(const Scan& scan, const BeamWindow& window, const Take& take) const {
    Codes chunk;
    for (const ScanSegment& run : window.runs)
      for (std::size_t done = 0; done < run.count; done += kChunk) {
        const std::size_t count = std::min(kChunk, run.count - done);
        codes(scan, run.first + done, count, chunk);
        for (std::size_t k = 0; k < count; ++k) take(chunk[k]);
      }
  }

 private:
  /// How many of the borders lie at or below a value; written out term by term, since a loop here would keep
  /// the loop over beams from being vectorised.
  template <std::size_t N, std::size_t... K>
  static std::int32_t passed([[maybe_unused]] float value, [[maybe_unused]] float unit,
                             [[maybe_unused]] const std::array<float, N>& borders,
                             std::index_sequence<K...>) {
    return (0 + ... + (value >= unit * borders[K + 1] ? 1 : 0));
  }

  std::int32_t code(float range_m, float x_m, float y_m) const {
    const float dx = x_m - x_;
    const float dy = y_m - y_;
    const float u = cos_ * dx + sin_ * dy;
    const float v = cos_ * dy - sin_ * dx;
    const float square = dx * dx + dy * dy;
    // All by arithmetic: what looks like a branch to the compiler keeps it from vectorising. -1 is all bits,
    // and x ^ -1 is -1 - x.
    const std::int32_t behind = -static_cast<std::int32_t>(u < 0.0F);
    const std::int32_t below = -static_cast<std::int32_t>(v < 0.0F);
    std::int32_t sector =
        passed(std::abs(v), std::abs(u), slopes_, std::make_index_sequence<Sectors / 4 - 1>{});
    sector = (sector ^ behind) + (behind & (Sectors / 2));
    sector = (sector ^ below) + (below & Sectors);
    const std::int32_t ring = passed(square, 1.0F, squares_, std::make_index_sequence<Rings - 1>{});
    const std::int32_t inside = static_cast<std::int32_t>(range_m > 0.0F) &
                                static_cast<std::int32_t>(square >= squares_[0]) &
                                static_cast<std::int32_t>(square < squares_[Rings]);
    return kOutside + ((ring * Sectors + sector - kOutside) & -inside);
  }

  float x_, y_, cos_, sin_;
  std::array<float, Rings + 1> squares_{};       // of the radii of the rings' borders
  std::array<float, Sectors / 4 + 1> slopes_{};  // of the sectors' borders in a quadrant, from 1
};

}  // namespace beaconless
