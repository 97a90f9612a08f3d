// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "beaconless/features/corner_of_lines.hpp"
#include "beaconless/features/corners.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr double kBehind_m = 0.10;  // a beam that goes this much further than a crossing looks through it

double gap_m(const ScanLine& line, const Eigen::Vector2d& point) {
  return std::min((line.a - point).norm(), (line.b - point).norm());
}

/// Whether a crossing lies beyond an end of the line, and not somewhere within it.
bool is_at_an_end(const ScanLine& line, const Eigen::Vector2d& point, double slack_m) {
  const double length = line.length_m();
  const double along = (line.b - line.a).dot(point - line.a) / std::max(length, 1e-12);
  return along <= std::min(slack_m, 0.5 * length) || along >= std::max(length - slack_m, 0.5 * length);
}

/// The beam whose bearing is nearest to a point's; size() outside of the field of view.
std::size_t beam_towards(const Scan& scan, const Eigen::Vector2d& point) {
  const auto nearest = static_cast<std::size_t>(std::lround(scan.beams_towards(point)));
  if (nearest < scan.size()) return nearest;
  return scan.is_full_circle() ? nearest % scan.size() : scan.size();
}

bool is_looked_through(const Scan& scan, const Eigen::Vector2d& point, std::size_t beam) {
  if (beam >= scan.size() || !scan.is_hit(beam)) return false;
  return static_cast<double>(scan.ranges_m()[beam]) > point.norm() + kBehind_m;
}

}  // namespace

void describe(Fields& fields, CrossingsConfig& config) {
  fields("min_angle_deg", config.min_angle_deg, {1.0, 90.0}, "least angle between the lines");
  fields("max_gap_m", config.max_gap_m, {0.0, 100.0},
         "most distance from the crossing to the nearer end of each line");
  fields("max_sigma_m", config.max_sigma_m, {1e-4, 100.0},
         "crossings less certain than this in any direction are left out");
}

void find_crossings(const Scan& scan, std::span<const ScanLine> lines, const CrossingsConfig& config,
                    std::vector<Corner>& corners) {
  corners.clear();
  const double min_sine = std::sin(radians(config.min_angle_deg));
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      auto corner = corner_of_lines(lines[i], lines[j], min_sine);
      if (!corner || corner->score * config.max_sigma_m < 1.0) continue;
      const Eigen::Vector2d point = corner->point;
      if (gap_m(lines[i], point) > config.max_gap_m || gap_m(lines[j], point) > config.max_gap_m) continue;
      if (!is_at_an_end(lines[i], point, kBehind_m) || !is_at_an_end(lines[j], point, kBehind_m)) continue;
      const std::size_t beam = beam_towards(scan, point);
      if (is_looked_through(scan, point, beam)) continue;
      corner->first_line = i;
      corner->second_line = j;
      corner->beam = std::min(beam, scan.size() - 1);
      corners.push_back(*corner);
    }
}

std::vector<Corner> find_crossings(const Scan& scan, std::span<const ScanLine> lines,
                                   const CrossingsConfig& config) {
  std::vector<Corner> corners;
  find_crossings(scan, lines, config, corners);
  return corners;
}

}  // namespace beaconless
