// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/segment2.hpp"

namespace beaconless {

/// Where a ray first meets a wall.
struct RayHit {
  double range_m = 0.0;
  std::size_t segment = 0;     ///< index into RayCaster::segments()
  double cos_incidence = 0.0;  ///< |n·u|: 1 when the ray meets the wall head-on, towards 0 when it grazes
};

/// Finds the first wall that a ray meets, exactly (no raster), among many.
///
/// Walls have two sides and no thickness. Outlines do not leak: both walls of a shared corner judge the
/// corner by the same product, so a ray through it meets at least one of them. A wall seen exactly edge-on,
/// one of no length and one that is not finite or further than kFarthest_m from the origin are not met.
/// Source: Amanatides and Woo, "A fast voxel traversal algorithm", Eurographics 1987, over buckets of walls.
class RayCaster {
 public:
  static constexpr double kFarthest_m = 1e8;

  /// Cost: O(n) time and memory, whatever the walls' lengths.
  explicit RayCaster(std::vector<Segment2> segments);

  /// The nearest hit at most `max_range_m` away along `direction` (a unit vector); nothing where the way is
  /// free.
  ///
  /// Cost: no allocation; the buckets between the origin and the hit.
  std::optional<RayHit> cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                             double max_range_m) const;

  const std::vector<Segment2>& segments() const { return segments_; }

 private:
  struct Walk;

  void choose_buckets();
  void fill_buckets();
  template <class Visit>
  void for_each_bucket_of(const Segment2& segment, Visit&& visit) const;
  int column(double x_m) const;
  int row(double y_m) const;

  std::vector<Segment2> segments_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();  // of the walls, with the margin
  Eigen::Vector2d high_ = Eigen::Vector2d::Zero();
  double bucket_m_ = 1.0;
  double margin_m_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;    // first_[b] … first_[b + 1]: the part of members_ that is bucket b
  std::vector<std::uint32_t> members_;  // indices of segments
};

}  // namespace beaconless
