// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/point_buckets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace beaconless {

PointBuckets::PointBuckets(std::span<const Eigen::Vector2d> points, double bucket_m) {
  // 1. How far the points reach.
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  double count = 0.0;
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) continue;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
    count += 1.0;
  }
  if (count == 0.0) return;
  low_ = low;

  // 2. Buckets of the size asked for, unless that makes too many; halves, lest the extent overflows.
  const double most = 4.0 * count + 16.0;
  const Eigen::Vector2d half = 0.5 * high - 0.5 * low;
  const double area_m = 2.0 * std::sqrt(half.x()) * std::sqrt(half.y()) / std::sqrt(most);
  bucket_m_ = std::max({bucket_m > 0.0 ? bucket_m : 0.0, area_m, 2.0 * half.maxCoeff() / most,
                        std::numeric_limits<double>::min()});
  columns_ = static_cast<int>(std::min(2.0 * (half.x() / bucket_m_), most)) + 1;
  rows_ = static_cast<int>(std::min(2.0 * (half.y() / bucket_m_), most)) + 1;

  // 3. Count, add up, fill.
  const auto bucket = [this](const Eigen::Vector2d& point) {
    return static_cast<std::size_t>(row(point.y())) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column(point.x()));
  };
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Eigen::Vector2d& point : points)
    if (point.allFinite()) ++first_[bucket(point) + 1];
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  members_.resize(first_.back());
  points_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    const std::uint32_t place = next[bucket(points[i])]++;
    members_[place] = static_cast<std::uint32_t>(i);
    points_[place] = points[i];
  }
}

int PointBuckets::bucket_of(double from_low_m, int count) const {
  return static_cast<int>(std::clamp(from_low_m / bucket_m_, 0.0, count - 1.0));
}

}  // namespace beaconless
