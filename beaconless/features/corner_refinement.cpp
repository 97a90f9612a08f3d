// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/corner_refinement.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/point_moments.hpp"

namespace beaconless {
namespace {

/// The unit vector along a line that leads from a corner on it to the points it was made of.
Eigen::Vector2d arm_of(const PrincipalLine& line, const Eigen::Vector2d& corner) {
  const Eigen::Vector2d along = line.along();
  return along.dot(line.centroid - corner) < 0.0 ? Eigen::Vector2d(-along) : along;
}

std::optional<RefinedCorner> corner_of(const PrincipalLine& p, const PrincipalLine& q) {
  constexpr double kLeastSine = 0.26;  // 15 degrees
  const auto corner = crossing(p, q, kLeastSine);
  if (!corner) return std::nullopt;
  return RefinedCorner{*corner, (arm_of(p, *corner) + arm_of(q, *corner)).normalized()};
}

PrincipalLine line_through(const UnrolledScan& points, std::size_t first, std::size_t last) {
  PointMoments sums;
  for (std::size_t place = first; place <= last; ++place)
    sums.add(static_cast<double>(points.x_m[place]), static_cast<double>(points.y_m[place]));
  return principal_line(sums);
}

/// Walks from the corner outwards (`step` +1 or -1) as long as points follow their line; gives that line.
/// The first `sure` points are taken as they are.
std::optional<PrincipalLine> grown_line(const UnrolledScan& points, const Eigen::Vector2d& corner,
                                        std::size_t start, std::size_t run_end, bool forward,
                                        std::size_t sure, const ArmLimits& limits) {
  PointMoments sums;
  PrincipalLine line;
  int outside = 0;
  std::size_t counted = 0;
  std::size_t settles = sure;  // the line is asked anew when it has half as many points again
  for (std::size_t place = start;; forward ? ++place : --place) {
    const Eigen::Vector2d point = points.point(place);
    if (counted >= sure) {
      if ((point - corner).squaredNorm() > limits.length_m * limits.length_m) break;
      if (counted == settles) {
        line = principal_line(sums);
        settles += settles / 2 + 1;
      }
      const bool off = std::abs(line.signed_distance_m(point)) > limits.tolerance_m;
      outside = off ? outside + 1 : 0;
      if (outside == 2) break;
      if (!off) sums.add(point.x(), point.y());
    } else {
      sums.add(point.x(), point.y());
    }
    ++counted;
    if (place == run_end) break;
  }
  if (sums.count < 2.0) return std::nullopt;
  return principal_line(sums);
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
  return corner_of(line_through(points, sides.left_first, sides.left_last),
                   line_through(points, sides.right_first, sides.right_last));
}

std::optional<RefinedCorner> refine_corner(const UnrolledScan& points, CornerSides sides, std::size_t centre,
                                           const ArmLimits& limits) {
  auto corner = meeting_point(points, sides);
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
  const auto better = left && right ? corner_of(*left, *right) : std::nullopt;
  return better ? better : corner;
}

}  // namespace beaconless
