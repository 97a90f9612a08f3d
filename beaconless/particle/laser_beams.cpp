// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/laser_beams.hpp"

#include <algorithm>

namespace beaconless {
namespace {

/// The i-th of `wanted` places spread evenly over `all`.
std::size_t even_place(std::size_t i, std::size_t wanted, std::size_t all) {
  return (2 * i + 1) * all / (2 * wanted);
}

}  // namespace

void choose_ends(std::span<const Eigen::Vector2d> points, int most, BeamEnds& ends) {
  const std::size_t wanted = std::min(points.size(), static_cast<std::size_t>(std::max(most, 0)));
  ends.x_m.clear();
  ends.y_m.clear();
  for (std::size_t i = 0; i < wanted; ++i) {
    const Eigen::Vector2d& point = points[even_place(i, wanted, points.size())];
    ends.x_m.push_back(static_cast<float>(point.x()));
    ends.y_m.push_back(static_cast<float>(point.y()));
  }
}

void choose_beams(const Scan& scan, int most, double reach_m, std::vector<CastBeam>& beams) {
  const auto tells = [&](std::size_t beam) {
    return scan.is_hit(beam) || scan.beams()[beam] == Beam::no_return;
  };
  std::size_t all = 0;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) all += tells(beam) ? 1 : 0;
  const std::size_t wanted = std::min(all, static_cast<std::size_t>(std::max(most, 0)));
  beams.clear();
  std::size_t place = 0;
  for (std::size_t beam = 0; beam < scan.size() && beams.size() < wanted; ++beam) {
    if (!tells(beam)) continue;
    if (place++ != even_place(beams.size(), wanted, all)) continue;
    const double range_m = static_cast<double>(scan.ranges_m()[beam]);
    const bool is_hit = scan.is_hit(beam) && range_m < reach_m;
    beams.push_back({scan.direction(beam), is_hit ? range_m : reach_m, is_hit});
  }
}

}  // namespace beaconless
