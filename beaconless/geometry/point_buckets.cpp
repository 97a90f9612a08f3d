// SPDX-License-Identifier: Apache-2.0
#include "beaconless/geometry/point_buckets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace beaconless {

namespace {

constexpr std::size_t kOneIn = 50;     // so many points at either end of an axis may lie far out
constexpr double kBeyond_share = 0.1;  // of the others' extent: what still counts as near them
constexpr double kBucketsPerPoint = 4.0;

/// From where to where along an axis buckets are worth having.
struct Extent {
  double low;
  double half;  // of its length, which may overflow
};

Extent extent_of(std::vector<double>& values) {
  const std::size_t spare = values.size() / kOneIn;
  const auto low_at = values.begin() + static_cast<std::ptrdiff_t>(spare);
  const auto high_at = values.end() - static_cast<std::ptrdiff_t>(spare + 1);
  std::nth_element(values.begin(), low_at, values.end());
  const double low = *low_at;
  const double least = *std::min_element(values.begin(), low_at + 1);
  std::nth_element(low_at, high_at, values.end());
  const double high = *high_at;
  const double most = *std::max_element(high_at, values.end());
  const double margin = kBeyond_share * (high - low);
  const double from = std::max(low - margin, least);
  return {from, 0.5 * std::min(high + margin, most) - 0.5 * from};
}

}  // namespace

PointBuckets::PointBuckets(std::span<const Eigen::Vector2d> points, double bucket_m) {
  // 1. How far the points reach, but for a few that lie far out: these share the outermost buckets.
  std::vector<double> x_m;
  std::vector<double> y_m;
  x_m.reserve(points.size());
  y_m.reserve(points.size());
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) continue;
    x_m.push_back(point.x());
    y_m.push_back(point.y());
  }
  if (x_m.empty()) return;
  const Extent x = extent_of(x_m);
  const Extent y = extent_of(y_m);
  low_ = {x.low, y.low};

  // 2. Buckets of the size asked for, unless that makes too many.
  const double most = kBucketsPerPoint * static_cast<double>(x_m.size()) + 16.0;
  const Eigen::Vector2d half(x.half, y.half);
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
