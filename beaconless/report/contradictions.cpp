// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/contradictions.hpp"

#include <algorithm>
#include <variant>

#include "beaconless/map/surface_map.hpp"

namespace beaconless::report {
namespace {

constexpr double kReach_m = 1.0;
constexpr double kMeets_m = 0.015;  // nearer than this to a surface a beam meets it
constexpr double kBehind_m = 0.15;  // … and passes through it if it ends this far on its other side
constexpr double kStart_m = 0.1;    // from the laser

template <SurfaceIndex Index>
double clear_m(const Index& map, const Eigen::Vector2d& at) {
  const auto surface = map.nearest(at);
  return surface ? surface->distance_m : map.reach_m();
}

/// How far a beam ends behind a surface, seen from where it began; negative in front of it.
double behind_m(const SurfacePoint& surface, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double side = surface.normal.dot(from - surface.point) < 0.0 ? 1.0 : -1.0;
  return side * surface.normal.dot(to - surface.point);
}

/// Sphere tracing as see_through_share does it. Differs: a beam that grazes the wall on which it ends does
/// not lead through it.
template <SurfaceIndex Index>
bool leads_through_a_wall(const Index& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double length_m = (to - from).norm();
  const Eigen::Vector2d way = (to - from) / length_m;
  for (double at_m = kStart_m; at_m < length_m - kContradicts_m;) {
    const auto surface = map.nearest(from + at_m * way);
    const double clear = surface ? surface->distance_m : map.reach_m();
    if (clear < kMeets_m && behind_m(*surface, from, to) > kBehind_m) return true;
    at_m += std::max(clear, kMeets_m);
  }
  return false;
}

template <SurfaceIndex Index>
Contradictions find_in(const Index& map, std::span<const PlacedScan> scans) {
  Contradictions found;
  for (const PlacedScan& placed : scans)
    for (std::size_t beam = 0; beam < placed.scan.size(); ++beam) {
      if (!placed.scan.is_hit(beam)) continue;
      const Eigen::Vector2d end = placed.map_from_laser * placed.scan.point(beam);
      if (!end.allFinite()) continue;
      ++found.beam_count;
      if (leads_through_a_wall(map, placed.map_from_laser.translation(), end))
        found.missing_walls.push_back(end);
      else if (clear_m(map, end) > kContradicts_m)
        found.new_things.push_back(end);
    }
  return found;
}

}  // namespace

Contradictions find_contradictions(const Map& map, std::span<const PlacedScan> scans) {
  if (scans.empty()) return {};
  const auto surfaces = build_surface_map(map, kReach_m);
  if (!surfaces) return {};
  return std::visit([&](const auto& index) { return find_in(index, scans); }, *surfaces);
}

}  // namespace beaconless::report
