// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/circles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_moments.hpp"

namespace beaconless {
namespace {

constexpr std::size_t kMostPieces = 5;  // that an arc may have been split into

using Points = std::vector<Eigen::Vector2d>;

/// The least sum of squared distances from two lines, each through one part of the row.
double two_lines_square(const Points& points) {
  PointMoments all;
  for (const Eigen::Vector2d& point : points) all.add(point.x(), point.y());
  PointMoments left;
  double best = principal_line(all).across_square;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    left.add(points[i].x(), points[i].y());
    best = std::min(best, principal_line(left).across_square + principal_line(all - left).across_square);
  }
  return best;
}

/// Whether the middle of a row stands out towards the sensor as far as that of an arc of `arc_rad` does, or
/// might but for the noise: (chord / 2) tan(arc / 4).
bool bulges(const Points& points, double arc_rad, double sigma_m) {
  const Eigen::Vector2d& first = points.front();
  const Eigen::Vector2d& middle = points[points.size() / 2];
  const Eigen::Vector2d chord = points.back() - first;
  const double length = std::sqrt(chord.squaredNorm());
  // Bearings ascend: the sensor is to the left of the chord. The middle beam is not the middle of the arc.
  const double cross = chord.x() * (middle.y() - first.y()) - chord.y() * (middle.x() - first.x());
  return cross > length * (0.35 * length * std::tan(0.25 * arc_rad) - 3.0 * sigma_m) && cross > 0.0;
}

/// Covariance of (x, y, radius) for noise along the beams.
Eigen::Matrix3d covariance_of(const Points& points, const Circle2& circle, double sigma_m) {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d normal = (point - circle.centre).normalized();
    const Eigen::Vector3d jacobian(-normal.x(), -normal.y(), -1.0);
    const double cosine = normal.dot(point) / std::max(std::sqrt(point.squaredNorm()), 1e-12);
    const Eigen::Matrix3d outer = jacobian * jacobian.transpose();
    hessian += outer;
    noise += sigma_m * sigma_m * cosine * cosine * outer;
  }
  const Eigen::Matrix3d inverse = hessian.inverse();
  return inverse * noise * inverse;
}

std::optional<ScanCircle> column(const Points& points, const CirclesConfig& config) {
  // 1. A bulge of enough beams, small enough.
  if (static_cast<int>(points.size()) < std::max(4, config.min_beams)) return std::nullopt;
  if ((points.back() - points.front()).squaredNorm() > 4.0 * config.max_radius_m * config.max_radius_m)
    return std::nullopt;
  if (!bulges(points, radians(config.min_arc_deg), config.sigma_m)) return std::nullopt;
  // 2. A circle that fits.
  const auto fit = fit_circle(points, config.sigma_m);
  if (!fit || fit->rms_m > config.max_rms_sigma * config.sigma_m) return std::nullopt;
  const Circle2& circle = fit->circle;
  if (circle.radius_m < config.min_radius_m || circle.radius_m > config.max_radius_m) return std::nullopt;
  if (circle.centre.squaredNorm() < circle.radius_m * circle.radius_m) return std::nullopt;
  // 3. Enough of it.
  const Eigen::Vector2d from = points.front() - circle.centre;
  const Eigen::Vector2d to = points.back() - circle.centre;
  double arc = std::atan2(from.y() * to.x() - from.x() * to.y(), from.dot(to));  // clockwise from the first
  if (arc < 0.0) arc += 2.0 * kPi;
  if (arc < radians(config.min_arc_deg)) return std::nullopt;
  // 4. Not two walls.
  const double gain = two_lines_square(points) - fit->rms_m * fit->rms_m * static_cast<double>(fit->count);
  if (gain < config.min_gain_chi_square * config.sigma_m * config.sigma_m) return std::nullopt;
  ScanCircle found{.fit = *fit, .arc_rad = arc};
  found.fit.covariance = covariance_of(points, circle, config.sigma_m);
  if (!found.fit.covariance.allFinite()) return std::nullopt;
  return found;
}

}  // namespace

void describe(Fields& fields, CirclesConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields.section("segmentation", config.segmentation, {"sigma_m"});
  fields("split_sigma", config.split_sigma, {0.0, 1000.0},
         "points further than this many sigmas from a chord may be where a column ends");
  fields("min_radius_m", config.min_radius_m, {0.001, 100.0}, "least radius of a column");
  fields("max_radius_m", config.max_radius_m, {0.001, 100.0}, "largest radius of a column");
  fields("min_arc_deg", config.min_arc_deg, {1.0, 360.0}, "how much of a column must be seen");
  fields("min_beams", config.min_beams, {4, 1000000}, "columns of fewer beams are left out");
  fields("max_rms_sigma", config.max_rms_sigma, {0.1, 100.0},
         "how far beams may stray from the circle, root mean square in sigmas");
  fields("min_gain_chi_square", config.min_gain_chi_square, {0.0, 1e6},
         "by how much two lines must fit worse than the circle");
}

void find_circles(const Scan& scan, const CirclesConfig& config, CirclesScratch& scratch,
                  std::vector<ScanCircle>& circles) {
  circles.clear();
  DistanceSegmentationConfig segmentation = config.segmentation;
  segmentation.sigma_m = config.sigma_m;
  segment_by_distance(scan, segmentation, scratch.segmentation, scratch.segments);
  split(scan, scratch.segments, {.epsilon_m = config.split_sigma * config.sigma_m}, scratch.splitting,
        scratch.pieces);
  const OrderedPoints points = ordered_points(scan, scratch.segments, scratch.points);
  const std::vector<ScanSegment>& pieces = scratch.pieces;

  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::size_t first = points.place_of(pieces[i]);
    // 1. How many pieces follow without a jump: they share their vertex, and two beams alone are a jump.
    std::size_t end = i;
    while (end < pieces.size() && end < i + kMostPieces && pieces[end].count > 2 &&
           (end == i ||
            points.place_of(pieces[end]) == points.place_of(pieces[end - 1]) + pieces[end - 1].count - 1))
      ++end;
    // 2. The longest run of them that is a column.
    for (; end > i; --end) {
      const std::size_t last = points.place_of(pieces[end - 1]) + pieces[end - 1].count - 1;
      scratch.run.clear();
      for (std::size_t at = first; at <= last; ++at) scratch.run.push_back(points[at]);
      if (auto found = column(scratch.run, config)) {
        found->beams = points.segment_of(first, last);
        circles.push_back(*found);
        i = end - 1;
        break;
      }
    }
  }
}

std::vector<ScanCircle> find_circles(const Scan& scan, const CirclesConfig& config) {
  CirclesScratch scratch;
  std::vector<ScanCircle> circles;
  find_circles(scan, config, scratch, circles);
  return circles;
}

}  // namespace beaconless
