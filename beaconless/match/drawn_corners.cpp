// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/drawn_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/point_buckets.hpp"

namespace beaconless {
namespace {

constexpr double kThickWall_m = 0.5;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Points with orientations, of which the nearest that is turned alike is looked up.
class Oriented {
 public:
  template <class Items, class Feature>
  Oriented(const Items& items, Feature&& feature, double radius_m, double turn_rad) : turn_rad_(turn_rad) {
    points_.reserve(items.size());
    orientations_rad_.reserve(items.size());
    for (const auto& item : items) {
      points_.push_back(feature(item).point);
      orientations_rad_.push_back(feature(item).orientation_rad);
    }
    near_ = PointBuckets(points_, radius_m);
  }

  /// kNone where there is none.
  std::size_t nearest(const Eigen::Vector2d& point, double orientation_rad, double radius_m) const {
    std::size_t best = kNone;
    double best_square = std::numeric_limits<double>::infinity();
    near_.for_each_within(point, radius_m, [&](std::size_t i) {
      if (std::abs(wrap_angle(orientations_rad_[i] - orientation_rad)) > turn_rad_) return;
      const double square = (points_[i] - point).squaredNorm();
      if (square > best_square || (square == best_square && i > best)) return;
      best_square = square;
      best = i;
    });
    return best;
  }

 private:
  double turn_rad_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> orientations_rad_;
  PointBuckets near_;
};

RepeatedFind as_drawn(const PlanCorner& corner) {
  return {{corner.point, Eigen::Matrix2d::Zero(), corner.orientation_rad, corner.opening_rad}, {}};
}

}  // namespace

std::vector<RepeatedFind> prefer_drawn_corners(std::span<const PlanCorner> drawn,
                                               std::span<const MapFind> finds,
                                               std::span<const RepeatedFind> found, const ViewsInSight& views,
                                               double view_range_m, const RepeatedFindsConfig& config) {
  const double turn_rad = radians(config.same_turn_deg);
  const Oriented corners(
      drawn, [](const PlanCorner& corner) -> const PlanCorner& { return corner; }, config.same_place_m,
      turn_rad);
  const Oriented places(
      found, [](const RepeatedFind& find) -> const PointFeature& { return find.feature; }, kThickWall_m,
      turn_rad);
  // 1. How often each drawn corner was found.
  std::vector<int> times(drawn.size(), 0);
  for (const MapFind& find : finds) {
    const std::size_t corner =
        corners.nearest(find.feature.point, find.feature.orientation_rad, config.same_place_m);
    if (corner != kNone) ++times[corner];
  }
  // 2. Those, and the ones that nothing speaks against.
  std::vector<RepeatedFind> kept;
  kept.reserve(drawn.size() + found.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const PlanCorner& corner = drawn[i];
    const bool unknown = times[i] == 0 && views.that_see(corner.point, view_range_m) < config.min_views &&
                         places.nearest(corner.point, corner.orientation_rad, kThickWall_m) == kNone;
    if (times[i] == 0 && !unknown) continue;
    kept.push_back(as_drawn(corner));
    kept.back().evidence.found_views = times[i];
  }
  // 3. What is no corner of the plan.
  for (const RepeatedFind& find : found)
    if (corners.nearest(find.feature.point, find.feature.orientation_rad, config.same_place_m) == kNone)
      kept.push_back(find);
  std::sort(kept.begin(), kept.end(), is_left_of);
  return kept;
}

}  // namespace beaconless
