// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/dominant_direction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kBins = 120;

/// The votes of one bin: unit vectors at four times the direction, summed.
struct Votes {
  float x = 0.0F;
  float y = 0.0F;
  float count = 0.0F;

  void operator+=(const Votes& other) {
    x += other.x;
    y += other.y;
    count += other.count;
  }
};

/// Bins by a number that grows with the angle, which is good enough to find the fullest.
std::size_t bin_of(float x, float y) {
  const float slope = y / (std::abs(x) + std::abs(y));
  const float quarters = x < 0.0F ? 2.0F - slope : (slope < 0.0F ? 4.0F + slope : slope);
  return std::min(static_cast<std::size_t>(quarters * (kBins / 4.0F)), kBins - 1);
}

}  // namespace

double dominant_direction(const BeamNeighbourhoods& around) {
  const UnrolledScan& points = around.points;
  std::array<Votes, kBins> bins{};
  // 1. every neighbourhood votes
  for (std::size_t place = points.begin(); place < points.end(); ++place) {
    const std::uint32_t first = around.first[place];
    const std::uint32_t last = around.last[place];
    if (!points.is_hit(place) || first == last) continue;
    const float x = points.x_m[last] - points.x_m[first];
    const float y = points.y_m[last] - points.y_m[first];
    const float twice_x = x * x - y * y;
    const float twice_y = 2.0F * x * y;
    const float squared = x * x + y * y;
    if (!(squared > 0.0F)) continue;
    const float scale = 1.0F / (squared * squared);
    const Votes vote{(twice_x * twice_x - twice_y * twice_y) * scale, 2.0F * twice_x * twice_y * scale, 1.0F};
    bins[bin_of(vote.x, vote.y)] += vote;
  }
  // 2. the fullest stretch of five bins wins
  Votes best;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    Votes stretch;
    for (std::size_t k = 0; k < 5; ++k) stretch += bins[(bin + k) % kBins];
    if (stretch.count > best.count) best = stretch;
  }
  const double direction = 0.25 * std::atan2(static_cast<double>(best.y), static_cast<double>(best.x));
  return direction < 0.0 ? direction + 0.5 * kPi : direction;
}

}  // namespace beaconless
