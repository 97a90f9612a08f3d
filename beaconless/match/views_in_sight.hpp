// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/geometry/point_buckets.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/ray_caster.hpp"

namespace beaconless {

/// Counts the views of a map that see a place.
class ViewsInSight {
 public:
  static constexpr double kBefore_m = 0.05;  ///< a wall this near before a place does not hide it

  /// `walls` must outlive this.
  ViewsInSight(std::span<const Pose2> views, const RayCaster& walls) : walls_(&walls) {
    places_.reserve(views.size());
    for (const Pose2& view : views) places_.push_back(view.translation());
    near_ = PointBuckets(places_, kBucket_m);
  }

  /// How many views no farther than `range_m` see a place. Cost: a ray a view.
  int that_see(const Eigen::Vector2d& place, double range_m) const {
    int count = 0;
    near_.for_each_within(place, range_m, [&](std::size_t i) {
      const Eigen::Vector2d way = place - places_[i];
      const double free_m = way.norm() - kBefore_m;
      count += free_m <= 0.0 || !walls_->cast(places_[i], way.normalized(), free_m) ? 1 : 0;
    });
    return count;
  }

  std::size_t size() const { return places_.size(); }

 private:
  static constexpr double kBucket_m = 2.0;

  const RayCaster* walls_;
  std::vector<Eigen::Vector2d> places_;
  PointBuckets near_;
};

}  // namespace beaconless
