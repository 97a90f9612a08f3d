// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

#include "beaconless/features/unrolled_scan.hpp"

namespace beaconless {

/// Places on both sides of a corner; both ends belong to them.
struct CornerSides {
  std::size_t left_first = 0;
  std::size_t left_last = 0;
  std::size_t right_first = 0;
  std::size_t right_last = 0;
};

/// How far the sides of a corner may grow, and what counts as straight.
struct ArmLimits {
  double length_m = 0.5;      ///< from the corner
  double tolerance_m = 0.03;  ///< a point this far off its line ends the side
};

/// A corner between beams, and the unit vector from it into the area between its sides.
struct RefinedCorner {
  Eigen::Vector2d point;
  Eigen::Vector2d bisector;
};

/// Where the lines through the two sides meet; nothing where they are parallel to within 15° or a side has
/// fewer than two points.
std::optional<RefinedCorner> meeting_point(const UnrolledScan& points, const CornerSides& sides);

/// The same with sides that are grown away from the corner while they stay straight, and cut anew where the
/// lines meet.
///
/// In: a corner's sides as a first guess, at least two points each. Out: the corner, or what meeting_point()
/// gives for the guess. Cost: a few passes over the grown sides. Source: total least squares on both sides,
/// intersected (dissertation Algorithm 5).
std::optional<RefinedCorner> refine_corner(const UnrolledScan& points, CornerSides sides, std::size_t centre,
                                           const ArmLimits& limits);

}  // namespace beaconless
