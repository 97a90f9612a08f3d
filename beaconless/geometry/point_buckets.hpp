// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace beaconless {

/// Finds the points around a place, exactly, among many that do not change.
///
/// Points that are not finite are never found. Cost: O(n) time and memory however far apart the points lie:
/// buckets are made larger than asked where there would be more than some twelve a point, and up to 2 % of
/// the points may lie far out on either side without making them so.
class PointBuckets {
 public:
  PointBuckets() = default;

  /// `bucket_m` is best about the radius of the searches to come.
  PointBuckets(std::span<const Eigen::Vector2d> points, double bucket_m);

  /// Calls `visit(index)` for every point no further than `radius_m` from a place, bucket by bucket, within a
  /// bucket in the order of the points. Allocates nothing. A place or radius that is not a number: no visit.
  template <class Visit>
  void for_each_within(const Eigen::Vector2d& place, double radius_m, Visit&& visit) const {
    if (members_.empty() || !place.allFinite() || !(radius_m >= 0.0)) return;
    const double square = radius_m * radius_m;
    const int first_column = column(place.x() - radius_m);
    const int last_column = column(place.x() + radius_m);
    const int last_row = row(place.y() + radius_m);
    for (int r = row(place.y() - radius_m); r <= last_row; ++r) {
      const std::size_t before = static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_);
      // Neighbours in a row lie side by side in the list.
      const std::uint32_t end = first_[before + static_cast<std::size_t>(last_column) + 1];
      for (std::uint32_t i = first_[before + static_cast<std::size_t>(first_column)]; i < end; ++i)
        if ((points_[i] - place).squaredNorm() <= square) visit(static_cast<std::size_t>(members_[i]));
    }
  }

  std::size_t size() const { return members_.size(); }  ///< points that can be found

 private:
  int column(double x_m) const { return bucket_of(x_m - low_.x(), columns_); }
  int row(double y_m) const { return bucket_of(y_m - low_.y(), rows_); }
  int bucket_of(double from_low_m, int count) const;

  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double bucket_m_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;     // first_[b] … first_[b + 1]: the part of members_ that is bucket b
  std::vector<std::uint32_t> members_;   // indices into the points given
  std::vector<Eigen::Vector2d> points_;  // theirs, in the order of members_
};

}  // namespace beaconless
