// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "beaconless/eval/crb.hpp"
#include "beaconless/eval/nees.hpp"
#include "beaconless/map/wall_index.hpp"
#include "beaconless/match/walls.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless::test {

/// A room to be seen and matched in.
struct WallRoom {
  explicit WallRoom(const FloorPlan& of, std::uint64_t seed = 21)
      : plan(of), walls(of.segments()), index(of), rng(seed) {}

  FloorPlan plan;
  RayCaster walls;
  WallIndex index;
  WallsConfig config;
  WallsScratch scratch;
  Rng rng;

  RawScan see(const Pose2& from, double sigma_m = 0.01) { return sweep(walls, from, sigma_m, rng); }
  MatchResult match(const RawScan& raw, const Pose2& guess, double prior_m) {
    return match_walls(points_of(Scan::make(raw).value()), index, guess, prior_m, config, scratch);
  }
  Eigen::Matrix3d bound(const Pose2& truth) const {
    return eval::accuracy_bound(eval::fisher_information(walls, eval::utm_30lx(), truth)).value();
  }
  Pose2 near(const Pose2& pose, double metres, double rad) {
    return {pose.x_m + rng.uniform(-metres, metres), pose.y_m + rng.uniform(-metres, metres),
            wrap_angle(pose.theta_rad + rng.uniform(-rad, rad))};
  }
  /// Where a robot can stand: inside the outermost walls, and no nearer to any than `margin_m`.
  Pose2 anywhere(double margin_m = 0.6) {
    const FloorPlan::Bounds bounds = plan.bounds();
    for (;;) {
      const Pose2 pose{rng.uniform(bounds.low.x(), bounds.high.x()),
                       rng.uniform(bounds.low.y(), bounds.high.y()), rng.uniform(-kPi, kPi)};
      const auto wall = index.nearest(pose.translation());
      const bool is_near = wall && wall->distance_m < margin_m;
      if (!is_near && is_shut_in(pose.translation())) return pose;
    }
  }

 private:
  /// Inside what is drawn first: a ray from inside a closed outline crosses it an odd number of times.
  bool is_shut_in(const Eigen::Vector2d& point) const {
    const auto& outline = plan.walls.front();
    bool is_inside = false;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[i + 1];
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) is_inside = !is_inside;
    }
    return is_inside;
  }
};

/// Errors of many fits against what is possible.
struct Trial {
  double squares_m2 = 0.0;
  double squares_rad2 = 0.0;
  double bound_m2 = 0.0;
  double bound_rad2 = 0.0;
  double nees_sum = 0.0;
  int outside = 0;  ///< of the 99.9 % ellipse of their own covariance
  int count = 0;

  void add(const MatchResult& match, const Pose2& truth, const Eigen::Matrix3d& bound) {
    squares_m2 += std::pow(distance_m(match.map_from_laser, truth), 2);
    squares_rad2 += std::pow(heading_difference_rad(match.map_from_laser, truth), 2);
    bound_m2 += bound(0, 0) + bound(1, 1);
    bound_rad2 += bound(2, 2);
    const double nees = eval::nees(match.map_from_laser, match.covariance, truth).value();
    nees_sum += nees;
    outside += nees > 16.27 ? 1 : 0;
    ++count;
  }
  double position_ratio() const { return std::sqrt(squares_m2 / bound_m2); }
  double heading_ratio() const { return std::sqrt(squares_rad2 / bound_rad2); }
  double mean_nees() const { return nees_sum / count; }
  double nees_slack() const { return 2.58 * std::sqrt(6.0 / count); }
  /// Of how many lie outside, when one in a thousand should: three standard deviations above.
  double most_outside() const { return 1e-3 * count + 3.0 * std::sqrt(1e-3 * 0.999 * count); }
};

}  // namespace beaconless::test
