// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hector.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "beaconless/map/grid_traversal.hpp"
#include "beaconless/match/observability.hpp"
#include "beaconless/match/straight_pieces.hpp"

namespace beaconless {
namespace {

constexpr double kFarthestGuess_m = 1e7;
constexpr double kFarthest_cells = 1e9;
constexpr double kShortestArm_m = 1e-3;
constexpr double kDamping = 1e-4;          // of H's trace: steps where nothing holds stay short
constexpr double kPiece_cells = 8.0;       // as long as the ripple of a drawn wall needs to repeat
constexpr std::size_t kPiecePoints = 150;  // enough of a scan to see what it holds
constexpr int kLastSteps = 2;              // after weak directions were put back
constexpr double kNothing = 1e-12;

Eigen::Vector3d way(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.theta_rad - from.theta_rad)};
}

/// A scan on one level of the pyramid; poses are the laser's in the level's grid.
struct LevelMatch {
  const HectorPoints& points;
  const OccupancyLevel& level;
  const HectorConfig& config;
  VectorLoop loop = VectorLoop::portable;
  double arm_m = std::max(points.arm_m, kShortestArm_m);

  HectorSums sums(const Pose2& pose) const { return sum_hector(points, level, pose, loop); }

  /// Which of two poses fits better. Coarse cells feel walls from afar, and things beside them: where a guess
  /// was good, clutter may have drawn it away.
  Pose2 better(const Pose2& one, const Pose2& other) const {
    const double misfit = fit_hector(points, level, one, 0.0, loop).misfit_sum;
    return fit_hector(points, level, other, 0.0, loop).misfit_sum < misfit ? other : one;
  }

  /// The Gauss-Newton step, damped as if a little of the information were spread over all directions.
  Eigen::Vector3d step(const HectorSums& here) const {
    const Eigen::Vector3d to_metres(1.0, 1.0, 1.0 / arm_m);
    Eigen::Matrix3d hessian = to_metres.asDiagonal() * here.hessian * to_metres.asDiagonal();
    hessian.diagonal().array() += kDamping * hessian.trace() + kNothing;
    return within_limits(to_metres.asDiagonal() *
                         (hessian.inverse() * to_metres.asDiagonal() * here.gradient));
  }

  /// The step that keeps out of weak directions.
  Eigen::Vector3d step(const HectorSums& here, const Observability& seen) const {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    const int strong = 3 - seen.weak_count;
    const auto ways = seen.directions.rightCols(strong);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> hessian =
        ways.transpose() * here.hessian * ways;
    hessian.diagonal().array() += kDamping * hessian.trace() + kNothing;
    if (strong > 0) step = ways * hessian.ldlt().solve(ways.transpose() * here.gradient);
    return within_limits(step);
  }

  Eigen::Vector3d within_limits(Eigen::Vector3d step) const {
    const double longest_m = config.max_step_cells * level.resolution_m();
    step.head<2>() *= std::min(1.0, longest_m / std::max(step.head<2>().norm(), longest_m));
    step.z() = std::clamp(step.z(), -config.max_turn_rad, config.max_turn_rad);
    return step;
  }
};

/// Which directions the walls near the points hold, and how well.
///
/// Not H: a wall drawn obliquely into cells has slopes along itself, up and down. They pull nowhere on the
/// whole, but in a corridor they add up to an H that seems to hold its axis. The scan knows better where its
/// surfaces face; H says only how much there is in all. Where a scan has hardly a straight piece (single
/// keypoints), H is all there is.
Observability held_by_walls(const LevelMatch& match, const HectorSums& here, const Pose2& pose) {
  const std::size_t stride = std::max<std::size_t>(1, match.points.count / kPiecePoints);
  const double cells = 1.0 / match.level.resolution_m();
  const Eigen::Matrix2d rotation = pose.rotation();
  const Eigen::Vector2d laser = cells * pose.translation() - Eigen::Vector2d(0.5, 0.5);
  StraightPieces pieces(kPiece_cells * match.level.resolution_m());
  int near_count = 0;
  for (std::size_t i = 0; i < match.points.count; i += stride) {
    const Eigen::Vector2d arm = rotation * Eigen::Vector2d(match.points.x_m[i], match.points.y_m[i]);
    const Eigen::Vector2d place = laser + cells * arm;
    if (!(place.cwiseAbs().maxCoeff() < kFarthest_cells) || !match.level.is_near_obstacle(cell_of(place)))
      continue;
    pieces.add(arm);
    ++near_count;
  }
  const StraightPieces::Held held = pieces.finish();

  const Eigen::Vector3d to_metres(1.0, 1.0, 1.0 / match.arm_m);
  const auto information = [&](const Eigen::Matrix3d& h) { return to_metres.cwiseAbs2().dot(h.diagonal()); };
  const double all = information(here.hessian);
  Eigen::Matrix3d hessian = here.hessian;
  if (2 * held.count > near_count && all > 0.0)
    hessian = all / information(held.information) * held.information;
  return {hessian, match.arm_m, 1.0, 1.0 / std::sqrt(std::max(match.config.least_share * all, kNothing))};
}

/// How much of the scan lies within on_map_m of walls, on the finest level that reaches so far.
void tell_fit(const HectorScratch& scratch, const OccupancyPyramid& map, const HectorConfig& config,
              MatchResult& result) {
  constexpr double kLeast = 0.05;
  const auto reaches = [&](const OccupancyLevel& level) {
    return wall_value(config.on_map_m, level.resolution_m()) > kLeast;
  };
  const auto found = std::find_if(map.levels.begin(), map.levels.end(), reaches);
  const OccupancyLevel& level = found == map.levels.end() ? map.levels.back() : *found;
  const double least = std::clamp(wall_value(config.on_map_m, level.resolution_m()), kLeast, 0.95);
  const Pose2 pose = level.map_from_grid().inverse() * result.map_from_laser;
  const HectorFit fit = fit_hector(scratch.points, level, pose, least, scratch.loop);
  const auto all = static_cast<double>(scratch.points.count);
  result.on_map_ratio = fit.near_count / all;
  result.misfit = std::clamp(fit.misfit_sum / all, 0.0, 1.0);
}

/// The covariance along the map's axes, from what is left of points on the finest level.
void tell_certainty(const LevelMatch& match, const Observability& seen, const Pose2& pose,
                    double wall_sigma_m, MatchResult& result) {
  // What is left of points counts as much as they pull; with few of them, what is known of the laser does
  // too.
  const HectorFit fit = fit_hector(match.points, match.level, pose, 0.0, match.loop);
  const double known = match.config.min_pairs;
  result.scale_m = std::sqrt((known * match.config.sigma_m * match.config.sigma_m + fit.pull_m2) /
                             (known + fit.slope_sum));
  result.rank = 3 - seen.weak_count;
  Eigen::Matrix3d map_from_grid = Eigen::Matrix3d::Identity();
  map_from_grid.topLeftCorner<2, 2>() = match.level.map_from_grid().rotation();
  result.weak_direction = map_from_grid * seen.directions.col(0).normalized();
  result.covariance = map_from_grid * (result.scale_m * result.scale_m * seen.inverse() + seen.unknown()) *
                      map_from_grid.transpose();
  result.covariance.diagonal() +=
      wall_sigma_m * wall_sigma_m * Eigen::Vector3d(1.0, 1.0, 1.0 / (match.arm_m * match.arm_m));
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
         "a direction with less than this share of all that the walls hold is held at the prediction");
  fields("on_map_m", config.on_map_m, {0.001, 1.0},
         "a point this near to a wall counts as explained by the map");
  fields("min_pairs", config.min_pairs, {3, 100000}, "fewer points near walls make no match");
}

MatchResult match_hector(std::span<const Eigen::Vector2d> points, const OccupancyPyramid& map,
                         const Pose2& guess, const HectorConfig& config, HectorScratch& scratch) {
  MatchResult none;
  none.status = MatchStatus::too_few_pairs;
  if (!guess.is_finite()) return none;
  none.map_from_laser = guess;
  if (guess.translation().norm() > kFarthestGuess_m) return none;
  // 1. The points that can be used.
  scratch.points.load(points);
  if (scratch.points.count == 0 || map.levels.empty()) return none;

  // 2. From the coarsest level to the finest.
  MatchResult result;
  Pose2 map_from_laser = guess;
  for (std::size_t i = map.levels.size(); i-- > 0;) {
    const LevelMatch match{scratch.points, map.levels[i], config, scratch.loop};
    const Pose2& map_from_grid = match.level.map_from_grid();
    Pose2 pose = map_from_grid.inverse() * map_from_laser;
    if (i == 0 && map.levels.size() > 1) pose = match.better(pose, map_from_grid.inverse() * guess);
    const int iterations = i == 0 ? config.fine_iterations : config.coarse_iterations;
    HectorSums sums;
    for (int iteration = 0; iteration < iterations; ++iteration) {
      sums = match.sums(pose);
      none.iterations = ++result.iterations;
      none.pair_count = result.pair_count = sums.near_count;
      if (sums.near_count < config.min_pairs) return none;
      const Eigen::Vector3d step = match.step(sums);
      pose = stepped(pose, step);
      const bool is_short =
          step.head<2>().norm() < config.converged_m && std::abs(step.z()) < config.converged_rad;
      result.status = is_short ? MatchStatus::converged : MatchStatus::max_iterations;
      if (is_short && config.stops_early) break;
    }
    if (i == 0) {
      // 3. What nothing holds goes back to where it was guessed.
      const Observability seen = held_by_walls(match, sums, pose);
      if (seen.weak_count > 0) {
        const Pose2 guessed = map_from_grid.inverse() * guess;
        pose = stepped(guessed, seen.determined(way(guessed, pose)));
        for (int k = 0; k < kLastSteps; ++k) {
          sums = match.sums(pose);
          pose = stepped(pose, match.step(sums, seen));
        }
      }
      tell_certainty(match, seen, pose, map.wall_sigma_m, result);
    }
    map_from_laser = map_from_grid * pose;
  }

  // 4. What the pose is worth.
  result.map_from_laser = map_from_laser;
  if (!result.map_from_laser.is_finite() || !result.covariance.allFinite()) return none;
  tell_fit(scratch, map, config, result);
  return result;
}

}  // namespace beaconless
