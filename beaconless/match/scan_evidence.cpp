// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/scan_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "beaconless/match/see_through.hpp"

namespace beaconless {
namespace {

constexpr double kOnMap_sigma = 2.0;
// Odds of what is not an end on the surface in view, beside 0.9 for that.
constexpr double kInFront = 0.1;
constexpr double kThroughOntoAnother = 0.1;  // a door that was shut when the map was made
constexpr double kThrough = 0.02;

template <SurfaceIndex Index>
ScanEvidence weigh(std::span<const Eigen::Vector2d> points, const Index& map, const Pose2& pose,
                   double sigma_m, std::size_t stride) {
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d origin = pose.translation();
  const double on_map_m = kOnMap_sigma * sigma_m;
  ScanEvidence sum{.log_likelihood = 0.0};
  double beams = 0.0;
  for (std::size_t i = stride / 2; i < points.size(); i += stride, beams += 1.0) {
    const double length_m = points[i].norm();
    const Eigen::Vector2d end = rotation * points[i];
    const auto surface = map.nearest(origin + end);
    const double distance_m = surface ? surface->distance_m : map.reach_m();
    const bool is_on = distance_m < on_map_m;
    if (passes_through(map, origin, Eigen::Vector2d(end / std::max(length_m, 1e-9)), length_m, sigma_m)) {
      sum.through += 1.0;
      sum.log_likelihood += std::log(is_on ? kThroughOntoAnother : kThrough);
      continue;
    }
    (is_on ? sum.on_map : sum.in_front) += 1.0;
    const double z = distance_m / sigma_m;
    sum.log_likelihood += std::log((1.0 - kInFront) * std::exp(-0.5 * z * z) + kInFront);
  }
  if (beams == 0.0) return {};
  return {sum.on_map / beams, sum.in_front / beams, sum.through / beams, sum.log_likelihood / beams};
}

}  // namespace

ScanEvidence weigh_scan(std::span<const Eigen::Vector2d> points, const SurfaceMap& map,
                        const Pose2& map_from_laser, double sigma_m, std::size_t beams) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / std::max<std::size_t>(1, beams));
  return std::visit([&](const auto& index) { return weigh(points, index, map_from_laser, sigma_m, stride); },
                    map);
}

}  // namespace beaconless
