// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/corners.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/features/corner_of_lines.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/circle_fit.hpp"

namespace beaconless {
namespace {

constexpr double kLargestFacets_m = 1.0;   // two of a column
constexpr double kRoundSlack = 6.0;        // chi²
constexpr std::size_t kMeeting_beams = 5;  // lines with no more than this between them follow each other

/// How many beams further on than the last beam of one line the next one begins; 0 where they share it.
std::size_t beams_apart(const ScanLine& p, const ScanLine& q, std::size_t beam_count) {
  return (q.beams.first + 2 * beam_count + 1 - (p.beams.first + p.beams.count)) % beam_count;
}

/// How a wall ends beside a corner.
struct WallEnd {
  double gap_m;      // from its last beam to the corner; negative where it goes on behind it
  double spacing_m;  // of its beams there
};

WallEnd wall_end(const Corner& corner, const ScanLine& line, const Eigen::Vector2d& end,
                 const Eigen::Vector2d& other_end, double step_rad) {
  // r Δθ / cos b with cos b = rho / r
  const double spacing = corner.point.squaredNorm() * step_rad / std::max(line.fit.line.rho_m, 1e-6);
  return {(other_end - end).normalized().dot(end - corner.point), spacing};
}

/// Whether a wall ends at the corner: not far before it, and hardly behind it, where only a wall can be seen
/// that the other one does not touch but hides.
bool ends_there(const WallEnd& end, const CornersConfig& config) {
  const double noise = config.reach_sigma * config.lines.sigma_m;
  return end.gap_m <= std::min(config.reach_most_m, config.reach_beams * end.spacing_m + noise) &&
         end.gap_m >= -std::min(config.reach_most_m, config.behind_beams * end.spacing_m + noise);
}

/// Of the beams at which two lines face each other, the one that met nearest to the corner.
std::size_t nearest_beam(const Scan& scan, const Corner& corner, const ScanLine& p, const ScanLine& q) {
  const std::size_t left = p.beams.beam(p.beams.count - 1, scan.size());
  const std::size_t right = q.beams.first;
  return (scan.point(left) - corner.point).squaredNorm() <= (scan.point(right) - corner.point).squaredNorm()
             ? left
             : right;
}

double chi_square(const ScanLine& line, double sigma_m) {
  const double ratio = line.fit.rms_m / sigma_m;
  return ratio * ratio * static_cast<double>(line.fit.count);
}

/// Whether a wall is too straight for a chord of the circle that it and its neighbour would be on.
///
/// Two neighbouring chords turn by (L1 + L2)/(2R), a chord is L²/(8R) away from its arc, and an arc 0.298
/// times that (root mean square) from the line through it.
bool is_straight(const Corner& corner, const ScanLine& line, double both_m) {
  const double length = line.length_m();
  const double sagitta = length * length * (kPi - corner.angle_rad) / (4.0 * both_m);
  return 0.298 * sagitta > 2.0 * line.fit.rms_m;
}

/// Whether the beams of two short walls lie on a circle as well as on the walls.
bool is_round(const Scan& scan, const Corner& corner, const ScanLine& p, const ScanLine& q, double sigma_m,
              std::vector<Eigen::Vector2d>& points) {
  const double both = p.length_m() + q.length_m();
  if (both > kLargestFacets_m || is_straight(corner, p, both) || is_straight(corner, q, both)) return false;
  points.clear();
  for (const ScanLine* line : {&p, &q})
    for (std::size_t k = 0; k < line->beams.count; ++k)
      if (const std::size_t beam = line->beams.beam(k, scan.size()); scan.is_hit(beam))
        points.push_back(scan.point(beam));
  const auto circle = fit_circle(points);
  if (!circle) return false;
  const double ratio = circle->rms_m / sigma_m;
  const double round = ratio * ratio * static_cast<double>(points.size());
  return round <= chi_square(p, sigma_m) + chi_square(q, sigma_m) + kRoundSlack;
}

}  // namespace

void describe(Fields& fields, CornersConfig& config) {
  fields.section("lines", config.lines);
  fields("min_angle_deg", config.min_angle_deg, {1.0, 90.0}, "least angle between the lines of a corner");
  fields("reach_beams", config.reach_beams, {0.0, 1000.0},
         "how far from the corner a wall may end, in distances between its beams there");
  fields("behind_beams", config.behind_beams, {0.0, 1000.0},
         "how far behind the corner a wall may still be seen, in distances between its beams there");
  fields("reach_sigma", config.reach_sigma, {0.0, 1000.0}, "what is added to that, in sigmas of the ranges");
  fields("reach_most_m", config.reach_most_m, {0.0, 100.0},
         "further than this from the corner no wall may end");
  fields("min_arm_m", config.min_arm_m, {0.0, 100.0}, "shorter walls make no corner");
  fields("max_sigma_m", config.max_sigma_m, {1e-4, 100.0},
         "corners less certain than this in any direction are left out");
  fields("is_round_left_out", config.is_round_left_out,
         "leave out corners where a round column explains both walls as well");
}

CornersConfig corners_of_the_dissertation() {
  CornersConfig config;
  config.lines.segmentation.threshold = DistanceThreshold::constant;
  config.lines.segmentation.constant_m = 0.10;
  config.lines.split_sigma = 0.0;
  config.lines.split_least_m = 0.15;
  config.lines.is_cut_again = false;
  config.lines.is_merged = false;
  config.lines.refine_passes = 0;
  config.lines.min_beams = 2;
  config.lines.min_length_m = 0.0;
  config.lines.least_incidence_deg = 0.0;
  config.lines.fit.method = LineFitMethod::regression;
  config.min_angle_deg = degrees(0.8);
  config.reach_beams = 0.0;
  config.behind_beams = 0.0;
  config.reach_sigma = 10.0;
  config.reach_most_m = 0.10;
  config.min_arm_m = 0.0;
  config.max_sigma_m = 100.0;
  config.is_round_left_out = false;
  return config;
}

void find_corners(const Scan& scan, const CornersConfig& config, CornersScratch& scratch,
                  std::vector<Corner>& corners) {
  corners.clear();
  find_lines(scan, config.lines, scratch.finding, scratch.lines);
  const std::vector<ScanLine>& lines = scratch.lines;
  const double min_sine = std::sin(radians(config.min_angle_deg));
  const double most_apart = 2.0 * config.reach_most_m;
  const double least_score = 1.0 / config.max_sigma_m;
  const std::size_t pairs = lines.size() < 2 ? 0 : lines.size() - (scan.is_full_circle() ? 0 : 1);
  for (std::size_t i = 0; i < pairs; ++i) {
    const std::size_t j = i + 1 < lines.size() ? i + 1 : 0;
    const ScanLine& p = lines[i];
    const ScanLine& q = lines[j];
    // 1. Neighbours, long enough to have a direction.
    if (beams_apart(p, q, scan.size()) > kMeeting_beams + 1) continue;
    if ((q.a - p.b).squaredNorm() > most_apart * most_apart) continue;
    // 2. Their crossing, sharp enough and certain enough.
    auto corner = corner_of_lines(p, q, min_sine);
    if (!corner || corner->arm_m < config.min_arm_m || corner->score < least_score) continue;
    // 3. Both end there.
    const double step = scan.angle_increment_rad();
    const WallEnd left = wall_end(*corner, p, p.b, p.a, step);
    const WallEnd right = wall_end(*corner, q, q.a, q.b, step);
    if (!ends_there(left, config) || !ends_there(right, config)) continue;
    corner->gap_m = std::max({0.0, left.gap_m - left.spacing_m, right.gap_m - right.spacing_m});
    // 4. Not two facets of a column.
    if (config.is_round_left_out && is_round(scan, *corner, p, q, config.lines.sigma_m, scratch.points))
      continue;
    corner->first_line = i;
    corner->second_line = j;
    corner->beam = nearest_beam(scan, *corner, p, q);
    corners.push_back(*corner);
  }
}

std::vector<Corner> find_corners(const Scan& scan, const CornersConfig& config,
                                 std::vector<ScanLine>& lines) {
  CornersScratch scratch;
  std::vector<Corner> corners;
  find_corners(scan, config, scratch, corners);
  lines = std::move(scratch.lines);
  return corners;
}

std::vector<Corner> find_corners(const Scan& scan, const CornersConfig& config) {
  std::vector<ScanLine> lines;
  return find_corners(scan, config, lines);
}

Keypoint keypoint_of(const Corner& corner) {
  return {.beam = corner.beam,
          .point = corner.point,
          .orientation_rad = corner.orientation_rad,
          .scale_m = corner.arm_m,
          .score = corner.score};
}

}  // namespace beaconless
