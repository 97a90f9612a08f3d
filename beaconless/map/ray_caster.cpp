// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace beaconless {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); }

bool can_be_met(const Segment2& segment) {
  const double farthest = std::max(segment.a.cwiseAbs().maxCoeff(), segment.b.cwiseAbs().maxCoeff());
  return segment.a.allFinite() && segment.b.allFinite() && farthest <= RayCaster::kFarthest_m &&
         segment.a != segment.b;
}

/// Where the ray meets the segment's line between its ends. The range is a mean of the two ends' ranges,
/// weighted by how far each lies beside the ray: no division can carry it beyond them.
std::optional<RayHit> meet(const Segment2& segment, const Eigen::Vector2d& origin,
                           const Eigen::Vector2d& direction) {
  const Eigen::Vector2d to_a = segment.a - origin;
  const Eigen::Vector2d to_b = segment.b - origin;
  const double side_a = cross(direction, to_a);
  const double side_b = cross(direction, to_b);
  if ((side_a > 0.0 && side_b > 0.0) || (side_a < 0.0 && side_b < 0.0) || side_a == side_b)
    return std::nullopt;
  const double share = side_a / (side_a - side_b);
  const double range = (1.0 - share) * direction.dot(to_a) + share * direction.dot(to_b);
  if (!(range >= 0.0)) return std::nullopt;
  return RayHit{range, 0, std::min(1.0, std::abs(side_b - side_a) / segment.length_m())};
}

}  // namespace

RayCaster::RayCaster(std::vector<Segment2> segments) : segments_(std::move(segments)) {
  choose_buckets();
  fill_buckets();
}

void RayCaster::choose_buckets() {
  double total_m = 0.0;
  double count = 0.0;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(kInfinity);
  Eigen::Vector2d high = -low;
  for (const Segment2& segment : segments_) {
    if (!can_be_met(segment)) continue;
    low = low.cwiseMin(segment.a).cwiseMin(segment.b);
    high = high.cwiseMax(segment.a).cwiseMax(segment.b);
    total_m += segment.length_m();
    count += 1.0;
  }
  if (count == 0.0) return;

  // Walls are listed in every bucket that they come within the margin of, so that what rounding does to a
  // ray's way through the buckets never hides one. It is far above the rounding and far below a bucket.
  const double reach_m = std::max({low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff(), 1e-3});
  margin_m_ = 1e-9 * reach_m;
  low_ = low - Eigen::Vector2d::Constant(margin_m_);
  high_ = high + Eigen::Vector2d::Constant(margin_m_);
  const Eigen::Vector2d extent = high_ - low_;
  // About four buckets a wall, and about eight entries a wall: a straight wall enters 1.3 buckets a bucket's
  // length.
  bucket_m_ = std::max({std::sqrt(extent.x() * extent.y() / (4.0 * count + 1000.0)),
                        1.3 * total_m / (8.0 * count + 1000.0), extent.maxCoeff() / (4.0 * count + 1000.0),
                        4.0 * margin_m_});
  columns_ = static_cast<int>(extent.x() / bucket_m_) + 1;
  rows_ = static_cast<int>(extent.y() / bucket_m_) + 1;
}

int RayCaster::column(double x_m) const {
  return static_cast<int>(std::clamp((x_m - low_.x()) / bucket_m_, 0.0, columns_ - 1.0));
}

int RayCaster::row(double y_m) const {
  return static_cast<int>(std::clamp((y_m - low_.y()) / bucket_m_, 0.0, rows_ - 1.0));
}

template <class Visit>
void RayCaster::for_each_bucket_of(const Segment2& segment, Visit&& visit) const {
  const bool rising = segment.a.y() <= segment.b.y();
  const Eigen::Vector2d& bottom = rising ? segment.a : segment.b;
  const Eigen::Vector2d& top = rising ? segment.b : segment.a;
  const double height = top.y() - bottom.y();
  const auto x_at = [&](double y) {
    return height > 0.0
               ? bottom.x() + std::clamp((y - bottom.y()) / height, 0.0, 1.0) * (top.x() - bottom.x())
               : bottom.x();
  };
  const int last_row = row(top.y() + margin_m_);
  for (int r = row(bottom.y() - margin_m_); r <= last_row; ++r) {
    const double from = x_at(low_.y() + r * bucket_m_ - margin_m_);
    const double to = height > margin_m_ ? x_at(low_.y() + (r + 1) * bucket_m_ + margin_m_) : top.x();
    const int last_column = column(std::max(from, to) + margin_m_);
    for (int c = column(std::min(from, to) - margin_m_); c <= last_column; ++c)
      visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c));
  }
}

void RayCaster::fill_buckets() {
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Segment2& segment : segments_)
    if (can_be_met(segment)) for_each_bucket_of(segment, [&](std::size_t bucket) { ++first_[bucket + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  members_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i)
    if (can_be_met(segments_[i]))
      for_each_bucket_of(segments_[i], [&](std::size_t bucket) {
        members_[next[bucket]++] = static_cast<std::uint32_t>(i);
      });
}

/// A ray's way along one axis: the bucket it is in, the range at which it leaves it, and the range from one
/// to the next.
struct RayCaster::Walk {
  int bucket;
  int step;
  double next_m;
  double per_bucket_m;

  Walk(int bucket_now, double low_m, double bucket_m, double from_m, double slope) : bucket(bucket_now) {
    step = slope > 0.0 ? 1 : -1;
    const double border_m = low_m + (bucket + (slope > 0.0 ? 1 : 0)) * bucket_m;
    next_m = slope == 0.0 ? kInfinity : (border_m - from_m) / slope;
    per_bucket_m = slope == 0.0 ? kInfinity : bucket_m / std::abs(slope);
  }

  void advance() {
    bucket += step;
    next_m += per_bucket_m;
  }
};

std::optional<RayHit> RayCaster::cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                      double max_range_m) const {
  if (members_.empty() || !origin.allFinite() || !direction.allFinite() || direction.isZero(0.0))
    return std::nullopt;

  // The part of the ray over the buckets.
  double enter = 0.0;
  double leave = max_range_m;
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < low_[axis] || origin[axis] > high_[axis]) return std::nullopt;
      continue;
    }
    const double to_low = (low_[axis] - origin[axis]) / direction[axis];
    const double to_high = (high_[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(to_low, to_high));
    leave = std::min(leave, std::max(to_low, to_high));
  }
  if (!(enter <= leave)) return std::nullopt;

  const Eigen::Vector2d start = origin + enter * direction;
  Walk x(column(start.x()), low_.x(), bucket_m_, origin.x(), direction.x());
  Walk y(row(start.y()), low_.y(), bucket_m_, origin.y(), direction.y());
  std::optional<RayHit> nearest;
  double nearest_m = max_range_m;
  while (x.bucket >= 0 && x.bucket < columns_ && y.bucket >= 0 && y.bucket < rows_) {
    const auto bucket = static_cast<std::size_t>(y.bucket) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(x.bucket);
    for (std::uint32_t i = first_[bucket]; i < first_[bucket + 1]; ++i) {
      const auto hit = meet(segments_[members_[i]], origin, direction);
      if (!hit || hit->range_m > nearest_m ||
          (nearest && hit->range_m == nearest_m && members_[i] >= nearest->segment))
        continue;
      nearest = hit;
      nearest->segment = members_[i];
      nearest_m = hit->range_m;
    }
    Walk& first_out = x.next_m < y.next_m ? x : y;
    if (first_out.next_m >= nearest_m) break;
    first_out.advance();
  }
  return nearest;
}

}  // namespace beaconless
