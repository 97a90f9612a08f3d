// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hector.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "beaconless/match/observability.hpp"

namespace beaconless {
namespace {

constexpr double kFarthestGuess_m = 1e7;
constexpr double kShortestArm_m = 1e-3;
constexpr double kClear = 0.1;        // share of H's trace; a direction above it is not in doubt
constexpr double kProbe_cells = 1.5;  // as far as a wall reaches, so that a probe leaves it
constexpr double kLeastHeld = 1e-9;

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.theta_rad + step.z())};
}

/// A scan on one level of the pyramid, its poses in the level's grid.
class LevelMatch {
 public:
  LevelMatch(const HectorPoints& points, const OccupancyLevel& level, const HectorConfig& config)
      : points_(points),
        level_(level),
        config_(config),
        loop_(fastest_hector_loop()),
        arm_m_(std::max(points.arm_m, kShortestArm_m)) {}

  HectorSums sums(const Pose2& pose, double least = 0.0) const {
    return sum_hector(points_, level_, pose, least, loop_);
  }

  /// The step from a pose, within its limits and without what it would move along weak directions.
  Eigen::Vector3d step(const HectorSums& here, const Pose2& pose) {
    Eigen::Vector3d step = weak_count_ == 0 && is_clear(here)
                               ? Eigen::Vector3d(here.hessian.inverse() * here.gradient)
                               : Eigen::Vector3d(observability(here, pose).inverse() * here.gradient);
    const double longest_m = config_.max_step_cells * level_.resolution_m();
    step.head<2>() *= std::min(1.0, longest_m / std::max(step.head<2>().norm(), longest_m));
    step.z() = std::clamp(step.z(), -config_.max_turn_rad, config_.max_turn_rad);
    return step;
  }

  /// What the points hold. How many directions they do not is found out once and stays.
  Observability observability(const HectorSums& here, const Pose2& pose) {
    const double least = std::max(config_.least_share * scaled(here).trace(), kLeastHeld);
    Observability seen(here.hessian, arm_m_, 1.0, 1.0 / std::sqrt(least));
    if (!is_settled_) {
      while (seen.weak_count < 3 && !is_held(seen, here, pose)) ++seen.weak_count;
      weak_count_ = seen.weak_count;
      is_settled_ = true;
    }
    seen.weak_count = std::max(seen.weak_count, weak_count_);
    return seen;
  }

 private:
  /// H with headings measured in metres at the points' mean distance.
  Eigen::Matrix3d scaled(const HectorSums& here) const {
    const Eigen::Vector3d to_metres(1.0, 1.0, 1.0 / arm_m_);
    return to_metres.asDiagonal() * here.hessian * to_metres.asDiagonal();
  }

  /// Whether no eigenvalue of H is in doubt. The least of three is at least 4 det / trace².
  bool is_clear(const HectorSums& here) const {
    const Eigen::Matrix3d hessian = scaled(here);
    const double trace = hessian.trace();
    return trace > kLeastHeld &&
           4.0 * hessian.determinant() > std::max(kClear, config_.least_share) * trace * trace * trace;
  }

  /// Whether the least certain direction that does not count as weak is held by walls, and not by the ripple
  /// of their cells alone: whether the fit gets worse by moving along it until walls are left.
  ///
  /// A wall drawn obliquely into cells has slopes along itself, up and down. In a corridor they add up to an
  /// H that seems to hold its axis. But they repeat, and over a few cells Σ (1 - M)² stays what it was.
  bool is_held(const Observability& seen, const HectorSums& here, const Pose2& pose) const {
    const int k = seen.weak_count;
    if (seen.hessian[k] > kClear * seen.hessian.sum()) return true;
    const Eigen::Vector3d way = kProbe_cells * level_.resolution_m() * seen.directions.col(k);
    const double there = 0.5 * (sums(moved(pose, way)).cost + sums(moved(pose, -way)).cost);
    return there - here.cost > config_.least_share * here.near_count;
  }

  const HectorPoints& points_;
  const OccupancyLevel& level_;
  const HectorConfig& config_;
  HectorLoop loop_;
  double arm_m_;
  int weak_count_ = 0;
  bool is_settled_ = false;
};

/// How much of the scan lies within on_map_m of walls, on the finest level that reaches so far.
void tell_fit(const HectorPoints& points, const OccupancyPyramid& map, const HectorConfig& config,
              MatchResult& result) {
  constexpr double kLeast = 0.05;
  const auto reaches = [&](const OccupancyLevel& level) {
    return wall_value(config.on_map_m, level.resolution_m()) > kLeast;
  };
  const auto found = std::find_if(map.levels.begin(), map.levels.end(), reaches);
  const OccupancyLevel& level = found == map.levels.end() ? map.levels.back() : *found;
  const double least = std::clamp(wall_value(config.on_map_m, level.resolution_m()), kLeast, 0.95);
  const HectorSums fit =
      LevelMatch(points, level, config).sums(level.map_from_grid().inverse() * result.map_from_laser, least);
  const auto all = static_cast<double>(points.count);
  result.on_map_ratio = fit.near_count / all;
  result.misfit = std::clamp(fit.cost / all, 0.0, 1.0);
}

/// The covariance along the map's axes, from what the finest level holds.
void tell_certainty(const Observability& seen, const HectorSums& last, const HectorPoints& points,
                    const OccupancyLevel& level, double wall_sigma_m, const HectorConfig& config,
                    MatchResult& result) {
  const double near_cost = last.cost - static_cast<double>(static_cast<int>(points.count) - last.near_count);
  const double residual_m = level.resolution_m() * std::sqrt(std::max(near_cost, 0.0) / last.near_count);
  const double arm_m = std::max(points.arm_m, kShortestArm_m);
  Eigen::Matrix3d map_from_grid = Eigen::Matrix3d::Identity();
  map_from_grid.topLeftCorner<2, 2>() = level.map_from_grid().rotation();
  result.scale_m = std::max(config.sigma_m, residual_m);
  result.rank = 3 - seen.weak_count;
  result.weak_direction = map_from_grid * seen.directions.col(0).normalized();
  result.covariance = map_from_grid * (result.scale_m * result.scale_m * seen.inverse() + seen.unknown()) *
                      map_from_grid.transpose();
  result.covariance.diagonal() +=
      wall_sigma_m * wall_sigma_m * Eigen::Vector3d(1.0, 1.0, 1.0 / (arm_m * arm_m));
}

}  // namespace

void describe(Fields& fields, HectorConfig& config) {
  fields("coarse_iterations", config.coarse_iterations, {0, 1000}, "steps on every level but the finest");
  fields("fine_iterations", config.fine_iterations, {1, 1000}, "steps on the finest level");
  fields("stops_early", config.stops_early,
         "a level ends when a step is shorter than converged_m and turns less than converged_rad");
  fields("converged_m", config.converged_m, {1e-9, 0.1}, "a match converged if its last step was shorter …");
  fields("converged_rad", config.converged_rad, {1e-9, 0.1}, "… and turned the laser less than this");
  fields("max_turn_rad", config.max_turn_rad, {1e-3, 3.0}, "a step turns the laser no more than this");
  fields("max_step_cells", config.max_step_cells, {0.01, 1000.0},
         "a step moves the laser no more cells of its level than this");
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields("least_share", config.least_share, {0.0, 1.0},
         "a direction that a smaller share of the points near walls holds is held at the prediction");
  fields("on_map_m", config.on_map_m, {0.001, 1.0},
         "a point this near to a wall counts as explained by the map");
  fields("min_pairs", config.min_pairs, {3, 100000}, "fewer points near walls make no match");
}

MatchResult match_hector(std::span<const Eigen::Vector2d> points, const OccupancyPyramid& map,
                         const Pose2& guess, const HectorConfig& config, HectorScratch& scratch) {
  MatchResult result;
  result.status = MatchStatus::too_few_pairs;
  if (!guess.is_finite() || guess.translation().norm() > kFarthestGuess_m) return result;
  result.map_from_laser = guess;
  // 1. The points that can be used.
  scratch.points.load(points);
  if (scratch.points.count == 0 || map.levels.empty()) return result;

  // 2. From the coarsest level to the finest: a fixed number of steps.
  Pose2 map_from_laser = guess;
  MatchResult found = result;
  for (std::size_t i = map.levels.size(); i-- > 0;) {
    const OccupancyLevel& level = map.levels[i];
    const bool is_finest = i == 0;
    LevelMatch match(scratch.points, level, config);
    Pose2 pose = level.map_from_grid().inverse() * map_from_laser;
    HectorSums sums;
    const int iterations = is_finest ? config.fine_iterations : config.coarse_iterations;
    found.status = MatchStatus::max_iterations;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      sums = match.sums(pose);
      result.pair_count = sums.near_count;
      ++result.iterations;
      if (sums.near_count < config.min_pairs) return result;
      const Eigen::Vector3d step = match.step(sums, pose);
      pose = moved(pose, step);
      const bool is_short =
          step.head<2>().norm() < config.converged_m && std::abs(step.z()) < config.converged_rad;
      found.status = is_short ? MatchStatus::converged : MatchStatus::max_iterations;
      if (is_short && config.stops_early) break;
    }
    map_from_laser = level.map_from_grid() * pose;
    if (is_finest)
      tell_certainty(match.observability(sums, pose), sums, scratch.points, level, map.wall_sigma_m, config,
                     found);
  }

  // 3. What the pose is worth.
  found.map_from_laser = map_from_laser;
  found.pair_count = result.pair_count;
  found.iterations = result.iterations;
  if (!found.map_from_laser.is_finite() || !found.covariance.allFinite()) return result;
  tell_fit(scratch.points, map, config, found);
  return found;
}

}  // namespace beaconless
