// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/corner_refinement.hpp"

#include <cmath>

namespace beaconless {
namespace {

/// Sums of points, from which the line through them follows at any time.
struct Moments {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< near the points, or digits are lost
  double n = 0.0;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Eigen::Vector2d& point) {
    const Eigen::Vector2d p = point - origin;
    n += 1.0;
    x += p.x();
    y += p.y();
    xx += p.x() * p.x();
    xy += p.x() * p.y();
    yy += p.y() * p.y();
  }
};

/// A line as a point on it and its unit normal.
struct PointNormal {
  Eigen::Vector2d point;
  Eigen::Vector2d normal;
  double distance_m(const Eigen::Vector2d& to) const { return std::abs(normal.dot(to - point)); }
};

/// Total least squares without trigonometry: the normal is the eigenvector of the lesser moment.
PointNormal line_of(const Moments& of) {
  const double sxx = of.xx - of.x * of.x / of.n;
  const double syy = of.yy - of.y * of.y / of.n;
  const double sxy = of.xy - of.x * of.y / of.n;
  const double half = 0.5 * (syy - sxx);
  const double root = std::sqrt(half * half + sxy * sxy);
  // of the two rows of (S - lesser eigenvalue), the longer one points along the line
  const Eigen::Vector2d along =
      half > 0.0 ? Eigen::Vector2d(sxy, half + root) : Eigen::Vector2d(root - half, sxy);
  const Eigen::Vector2d unit = along.squaredNorm() > 0.0 ? along.normalized() : Eigen::Vector2d(1, 0);
  return {of.origin + Eigen::Vector2d(of.x, of.y) / of.n, {-unit.y(), unit.x()}};
}

/// The unit vector along a line that leads from a corner on it to the points it was made of.
Eigen::Vector2d arm_of(const PointNormal& line, const Eigen::Vector2d& corner) {
  const Eigen::Vector2d along(-line.normal.y(), line.normal.x());
  return along.dot(line.point - corner) < 0.0 ? Eigen::Vector2d(-along) : along;
}

std::optional<RefinedCorner> crossing(const PointNormal& p, const PointNormal& q) {
  constexpr double kLeastSine = 0.26;  // 15 degrees
  const double sine = p.normal.x() * q.normal.y() - p.normal.y() * q.normal.x();
  if (!(std::abs(sine) >= kLeastSine)) return std::nullopt;
  const double a = p.normal.dot(p.point);
  const double b = q.normal.dot(q.point);
  const Eigen::Vector2d corner{(a * q.normal.y() - b * p.normal.y()) / sine,
                               (b * p.normal.x() - a * q.normal.x()) / sine};
  return RefinedCorner{corner, (arm_of(p, corner) + arm_of(q, corner)).normalized()};
}

PointNormal line_through(const UnrolledScan& points, std::size_t first, std::size_t last) {
  Moments sums{.origin = points.point(first)};
  for (std::size_t place = first; place <= last; ++place) sums.add(points.point(place));
  return line_of(sums);
}

/// Walks from the corner outwards (`step` +1 or -1) as long as points follow their line; gives that line.
/// The first `sure` points are taken as they are.
std::optional<PointNormal> grown_line(const UnrolledScan& points, const Eigen::Vector2d& corner,
                                      std::size_t start, std::size_t run_end, bool forward, std::size_t sure,
                                      const ArmLimits& limits) {
  Moments sums{.origin = corner};
  PointNormal line{corner, {0, 0}};
  int outside = 0;
  std::size_t counted = 0;
  for (std::size_t place = start;; forward ? ++place : --place) {
    const Eigen::Vector2d point = points.point(place);
    if ((point - corner).squaredNorm() > limits.length_m * limits.length_m && counted >= sure) break;
    if (counted >= sure) {
      if (counted % 4 == sure % 4) line = line_of(sums);  // the line settles soon: no need to ask each time
      const bool off = line.distance_m(point) > limits.tolerance_m;
      outside = off ? outside + 1 : 0;
      if (outside == 2) break;
      if (!off) sums.add(point);
    } else {
      sums.add(point);
    }
    ++counted;
    if (place == run_end) break;
  }
  if (sums.n < 2.0) return std::nullopt;
  return line_of(sums);
}

/// The place whose bearing is nearest to that of a point, among first … last.
std::size_t place_towards(const UnrolledScan& points, const Eigen::Vector2d& to, std::size_t first,
                          std::size_t last) {
  // bearings grow with places, so the sign of the cross product tells the side
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    const Eigen::Vector2d point = points.point(middle);
    if (point.x() * to.y() - point.y() * to.x() > 0.0)
      first = middle + 1;
    else
      last = middle;
  }
  return first;
}

}  // namespace

std::optional<RefinedCorner> meeting_point(const UnrolledScan& points, const CornerSides& sides) {
  if (sides.left_last <= sides.left_first || sides.right_last <= sides.right_first) return std::nullopt;
  return crossing(line_through(points, sides.left_first, sides.left_last),
                  line_through(points, sides.right_first, sides.right_last));
}

std::optional<RefinedCorner> refine_corner(const UnrolledScan& points, CornerSides sides, std::size_t centre,
                                           const ArmLimits& limits) {
  const auto corner = meeting_point(points, sides);
  if (!corner) return corner;
  // 1. cut the neighbourhood where the lines meet; `split` is the first place on the far side of it
  const std::size_t split = place_towards(points, corner->point, sides.left_first + 2, sides.right_last - 1);
  // 2. grow both sides from there; half of the neighbourhood is taken as it is
  const std::size_t sure_left = std::max<std::size_t>(2, (split - sides.left_first) / 2);
  const std::size_t sure_right = std::max<std::size_t>(2, (sides.right_last - split + 1) / 2);
  const auto left =
      grown_line(points, corner->point, split - 1, points.run_first[centre], false, sure_left, limits);
  const auto right =
      grown_line(points, corner->point, split, points.run_last[centre], true, sure_right, limits);
  // 3. and let them meet again
  const auto better = left && right ? crossing(*left, *right) : std::nullopt;
  return better ? better : corner;
}

}  // namespace beaconless
