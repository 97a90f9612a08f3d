// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/repeatability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace beaconless::eval {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double ratio(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Whether a scan sees the place of a point, given in its own frame.
bool sees(const Scan& scan, const Eigen::Vector2d& point, double occluded_m) {
  const double range = point.norm();
  if (range < scan.range_min_m() || range >= scan.range_max_m()) return false;
  // 1. outside the field of view?
  const auto at = static_cast<std::size_t>(scan.beams_towards(point));
  if (at + 1 >= scan.size() && !(scan.is_full_circle() && at < scan.size())) return false;
  // 2. is something in front of it on both sides?
  double reach = 0.0;
  for (const std::size_t beam : {at, (at + 1) % scan.size()}) {
    if (!scan.is_hit(beam)) return true;
    reach = std::max(reach, static_cast<double>(scan.ranges_m()[beam]));
  }
  return reach + occluded_m >= range;
}

/// Those of the points of `from` that `to` sees, in the frame of `to`.
Points visible_points(const View& from, const View& to, double occluded_m) {
  const Pose2 to_from_from = to.map_from_laser.inverse() * from.map_from_laser;
  Points visible;
  visible.reserve(from.points.size());
  for (const Eigen::Vector2d& point : from.points) {
    const Eigen::Vector2d moved = to_from_from * point;
    if (sees(*to.scan, moved, occluded_m)) visible.push_back(moved);
  }
  return visible;
}

struct Nearest {
  std::size_t index = std::numeric_limits<std::size_t>::max();
  double distance_m = std::numeric_limits<double>::infinity();
};

Nearest nearest(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& to) {
  Nearest best;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double distance = (points[i] - to).norm(); distance < best.distance_m) best = {i, distance};
  return best;
}

}  // namespace

double Repeatability::found_ratio() const { return ratio(found_count, visible_count); }
double Repeatability::matched_ratio() const { return ratio(matched_count, common_count); }
double Repeatability::points_per_scan() const { return ratio(point_count, pair_count); }

double Repeatability::mean_distance_m() const {
  if (distances_m.empty()) return 0.0;
  return std::accumulate(distances_m.begin(), distances_m.end(), 0.0) /
         static_cast<double>(distances_m.size());
}

double Repeatability::rms_distance_m() const {
  if (distances_m.empty()) return 0.0;
  const double sum = std::inner_product(distances_m.begin(), distances_m.end(), distances_m.begin(), 0.0);
  return std::sqrt(sum / static_cast<double>(distances_m.size()));
}

Repeatability repeatability(std::span<const View> views, std::size_t gap, const RepeatabilityConfig& config) {
  Repeatability sum;
  for (std::size_t k = 0; k + gap < views.size(); ++k) {
    const View& earlier = views[k];
    const View& later = views[k + gap];
    const Points there = visible_points(earlier, later, config.occluded_m);
    const std::size_t visible_back = visible_points(later, earlier, config.occluded_m).size();
    sum.pair_count += 1;
    sum.point_count += earlier.points.size();
    sum.visible_count += there.size();
    sum.common_count += std::min(there.size(), visible_back);
    for (std::size_t i = 0; i < there.size(); ++i) {
      const Nearest found = nearest(later.points, there[i]);
      if (!(found.distance_m <= config.within_m)) continue;
      sum.found_count += 1;
      sum.distances_m.push_back(found.distance_m);
      sum.matched_count += nearest(there, later.points[found.index]).index == i ? 1 : 0;
    }
  }
  return sum;
}

}  // namespace beaconless::eval
