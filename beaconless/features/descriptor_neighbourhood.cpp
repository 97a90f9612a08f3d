// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/descriptor_neighbourhood.hpp"

#include <algorithm>

#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

/// The beams of [low, high] that exist, as a run.
ScanSegment clipped(double low, double high, std::size_t size) {
  const double last = static_cast<double>(size) - 1.0;
  const double from = std::max(0.0, std::ceil(low));
  const double to = std::min(last, std::floor(high));
  if (!(from <= to)) return {};
  return {static_cast<std::size_t>(from), static_cast<std::size_t>(to - from) + 1};
}

}  // namespace

void describe(Fields& fields, NeighbourhoodConfig& config) {
  fields("radius_m", config.radius_m, {0.01, 100.0}, "beams that end this near to the keypoint count");
  fields("growth_per_m", config.growth_per_m, {0.0, 1.0},
         "radius grows with range r by exp(growth r); 0: the same everywhere, as maps want it");
}

BeamWindow beams_around(const Scan& scan, const Eigen::Vector2d& point, double radius_m) {
  const double range_m = point.norm();
  if (!(radius_m > 0.0) || !std::isfinite(range_m)) return {};
  if (radius_m >= range_m) return {{ScanSegment{0, scan.size()}, ScanSegment{}}};

  // 1. The window in beams; a hair is added so that a beam on its edge is not lost to rounding.
  const double step = scan.angle_increment_rad();
  const double turn = 2.0 * kPi / step;  // beams in a full circle
  const double half = std::asin(radius_m / range_m) / step + 1e-6;
  double centre = (std::atan2(point.y(), point.x()) - scan.angle_min_rad()) / step;
  centre -= turn * std::floor(centre / turn);
  if (2.0 * half + 1.0 >= turn) return {{ScanSegment{0, scan.size()}, ScanSegment{}}};

  // 2. The same window one turn earlier or later may reach into the arrays, too. On a full circle the turn is
  //    a whole number of beams but for rounding.
  const double whole = scan.is_full_circle() ? static_cast<double>(scan.size()) : turn;
  BeamWindow window;
  window.runs[0] = clipped(centre - half, centre + half, scan.size());
  const ScanSegment earlier = clipped(centre - half - whole, centre + half - whole, scan.size());
  window.runs[1] =
      earlier.count > 0 ? earlier : clipped(centre - half + whole, centre + half + whole, scan.size());
  return window;
}

}  // namespace beaconless
