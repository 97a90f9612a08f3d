// SPDX-License-Identifier: Apache-2.0
#include "bench/trust/way.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/sim/drive.hpp"

namespace beaconless::trust {
namespace {

constexpr double kClearance_m = 0.42;  // a door is a metre wide or more
constexpr double kStep_m = 0.1;

/// Where a robot can be.
struct FreeSpace {
  explicit FreeSpace(const Building& of) : building(of), index(of.plan()) {}

  const Building& building;
  WallIndex index;

  bool has(const Eigen::Vector2d& point) const {
    if (!building.is_inside(point)) return false;
    const auto wall = index.nearest(point);
    return !wall || wall->distance_m >= kClearance_m;
  }

  bool joins(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    const int steps = std::max(1, static_cast<int>((b - a).norm() / kStep_m));
    for (int i = 1; i <= steps; ++i)
      if (!has(a + static_cast<double>(i) / steps * (b - a))) return false;
    return true;
  }

  Eigen::Vector2d anywhere(Rng& rng) const {
    constexpr int kTries = 100'000;
    const FloorPlan::Bounds& bounds = index.bounds();
    for (int i = 0; i < kTries; ++i) {
      Eigen::Vector2d point(rng.uniform(bounds.low.x(), bounds.high.x()),
                            rng.uniform(bounds.low.y(), bounds.high.y()));
      if (has(point)) return point;
    }
    throw BadResult({.where = "a building", .what = "has no free place", .remedy = ""});
  }

  std::optional<Eigen::Vector2d> next(const Eigen::Vector2d& from, Rng& rng) const {
    constexpr int kTries = 80;
    for (int i = 0; i < kTries; ++i) {
      const double way = rng.uniform(-kPi, kPi);
      const Eigen::Vector2d to = from + rng.uniform(0.7, 6.0) * Eigen::Vector2d(std::cos(way), std::sin(way));
      if (joins(from, to)) return to;
    }
    return std::nullopt;
  }
};

}  // namespace

sim::Path make_way(const Building& building, double duration_s, Rng& rng) {
  const FreeSpace space(building);
  sim::Waypoints way;
  way.speed_mps = rng.uniform(0.2, 1.5);
  way.rate_degps = rng.uniform(20.0, 90.0);
  way.points.push_back(space.anywhere(rng));
  while (way.points.size() < 2 || sim::Drive(way).duration_s() < duration_s) {
    const auto next = space.next(way.points.back(), rng);
    if (!next) break;
    way.points.push_back(*next);
  }
  if (way.points.size() < 2) {
    const Eigen::Vector2d& at = way.points.front();
    return sim::Turning{.x_m = at.x(), .y_m = at.y(), .heading_deg = rng.uniform(-180.0, 180.0)};
  }
  return way;
}

}  // namespace beaconless::trust
