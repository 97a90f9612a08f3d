// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/walls.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/geometry/pose_covariance.hpp"
#include "beaconless/match/observability.hpp"
#include "beaconless/match/protect_walls.hpp"
#include "beaconless/match/wall_pairs.hpp"

namespace beaconless {
namespace {

constexpr int kRounds = 6;         // of pairing
constexpr int kSteps = 8;          // of Gauss-Newton on the same pairs
constexpr double kStill_m = 1e-4;  // a step below both is the last: the next one would be its square
constexpr double kStill_rad = 5e-5;
constexpr double kMoved_sigma = 0.25;  // ends of beams that move more than this are paired again
constexpr double kLeastCurvature = 0.5;
constexpr double kSettled = 0.95;     // of the scale before, and it narrows no more
constexpr double kNarrowing = 2.0;    // of the scale from step to step, at most
constexpr double kByChance = 2.5;     // over the root of the number of beams, a scale may be above 1 …
constexpr double kAcross = 0.75;      // of what is off along the beams, over all angles of incidence
constexpr double kPriorBeams = 10.0;  // that fit as well as the noise says, beside those of the scan

/// About the mean of z² under Tukey's weights for a Gaussian, divided by the mean weight: 1 for a wide cut.
double expected_square(double cut) { return 1.0 - 4.0 / (cut * cut + 1.0); }

/// Where Gauss-Newton ends on fixed pairs, and the sums there.
struct Fit {
  Pose2 step;
  WallSums sums;  // a last small step before it
  Eigen::Vector3d last_step = Eigen::Vector3d::Zero();
  double scale = 1.0;  // measured, in expected standard deviations
  int iterations = 0;
  bool is_marked = false;  // the sums were left at the marks
};

/// What the weights add to the variance of a pose. Source: Huber 1981, 6.3.
double variance_factor_of(const WallSums& sums) {
  const double count = std::max(sums.weight, 1.0);
  const double influence = (sums.squared_influence + kPriorBeams) / (count + kPriorBeams);
  const double curvature = std::clamp(sums.curvature / count, 0.2, 1.0);
  return influence / (curvature * curvature);
}

/// The weights fall as residuals grow, which H does not know of; their mean curvature makes up for it.
double step_curvature_of(const WallSums& sums) {
  return std::clamp(sums.curvature / std::max(sums.weight, 1.0), kLeastCurvature, 1.0);
}

double arm_of(const WallSums& sums) {
  return std::sqrt(sums.arm_squares_m2 / std::max(sums.weight, 1e-9)) + 1e-3;
}

/// How far the ends of beams have moved since they were paired.
double moved_m(const Fit& fit) {
  return fit.step.translation().norm() + arm_of(fit.sums) * std::abs(fit.step.theta_rad);
}

/// Sums are left at marks where they may be the last of all: near enough to where the beams were paired that
/// they need not be paired again, after a step or, in a later round of pairing, `is_near` from the beginning.
Fit descend(double first_scale, double still_m, bool is_near, const WallsConfig& config, VectorLoop loop,
            WallsScratch& scratch) {
  Fit fit;
  double next_scale = std::max(1.0, first_scale);
  for (fit.iterations = 1; fit.iterations <= kSteps; ++fit.iterations) {
    // 1. How the beams fit here, and what they scatter by.
    fit.scale = next_scale;
    fit.is_marked = (is_near || fit.iterations > 1) && moved_m(fit) < still_m;
    if (fit.is_marked) divide(scratch.beams, loop, scratch.marks, scratch.pieces);
    fit.sums = sum_walls(scratch.beams, fit.step, config.cut_sigma * fit.scale, loop,
                         fit.is_marked ? &scratch.marks : nullptr);
    const double measured = std::sqrt((fit.sums.weighted_squares + kPriorBeams) /
                                      (fit.sums.weight + kPriorBeams) / expected_square(config.cut_sigma));
    next_scale = std::clamp(measured, std::max(1.0, fit.scale / kNarrowing), std::max(1.0, fit.scale));
    // 2. Step along what they determine. What a small last step would change about the sums is its square.
    const Observability seen(fit.sums.hessian, arm_of(fit.sums), fit.scale, config.unobservable_sigma_m);
    fit.last_step = -seen.inverse() * fit.sums.gradient / step_curvature_of(fit.sums);
    fit.step = stepped(fit.step, fit.last_step);
    const bool is_still =
        fit.last_step.head<2>().norm() < kStill_m && std::abs(fit.last_step.z()) < kStill_rad;
    if (is_still && next_scale > kSettled * fit.scale) break;
  }
  return fit;
}

/// Of the pose that maximises the likelihood, with the variance of a range measured where it was fitted.
Eigen::Matrix3d covariance_of(const Fit& fit, const Observability& seen, const Pose2& pose,
                              double map_sigma_m) {
  const Eigen::Matrix3d to_map = turn_of(pose);
  Eigen::Matrix3d covariance = variance_factor_of(fit.sums) * seen.inverse() + seen.unknown();
  // The map's error does not average out over the beams of a wall.
  const double arm_m = arm_of(fit.sums);
  covariance.diagonal() += map_sigma_m * map_sigma_m * Eigen::Vector3d(1.0, 1.0, 1.0 / (arm_m * arm_m));
  return to_map * covariance * to_map.transpose();
}

/// What the protection level is made of.
FittedWalls left_behind(const Fit& fit, const Pose2& paired_at, double map_sigma_m, const WallsConfig& config,
                        VectorLoop loop, WallsScratch& scratch) {
  FittedWalls left{paired_at,
                   fit.step,
                   fit.sums.weight,
                   {variance_factor_of(fit.sums), step_curvature_of(fit.sums), map_sigma_m, arm_of(fit.sums),
                    fit.last_step}};
  if (!fit.is_marked) {
    divide(scratch.beams, loop, scratch.marks, scratch.pieces);
    sum_walls(scratch.beams, fit.step, config.cut_sigma * fit.scale, loop, &scratch.marks);
    left.known.last_step.setZero();
  }
  add_up(scratch.marks, scratch.pieces);
  return left;
}

}  // namespace

void describe(Fields& fields, WallsConfig& config) {
  fields("sigma_m", config.sigma_m, {1e-4, 1.0}, "standard deviation of the laser's ranges");
  fields("sigma_per_m", config.sigma_per_m, {0.0, 0.1}, "what that grows by with every metre of range");
  fields("footprint_rad", config.footprint_rad, {0.0, 0.1},
         "half the divergence of a beam; at a slant it sees a piece of the wall");
  fields("map_sigma_m", config.map_sigma_m, {0.0, 1.0},
         "standard deviation of the map's walls; what the residuals tell is added");
  fields("gate_m", config.gate_m, {0.01, 10.0},
         "from a rough guess, beams that end further from every wall are left out");
  fields("near_gate_m", config.near_gate_m, {0.005, 1.0},
         "the same from a good guess, unless noise is larger");
  fields("cut_sigma", config.cut_sigma, {3.0, 100.0},
         "beams this many standard deviations from their wall know nothing");
  fields("max_incidence_deg", config.max_incidence_deg, {10.0, 89.9},
         "beams that graze a wall more than this are left out");
  fields("on_map_m", config.on_map_m, {0.001, 1.0},
         "a point this near to a wall counts as explained by the map");
  fields("unobservable_sigma_m", config.unobservable_sigma_m, {1e-3, 100.0},
         "a direction that the scan tells less well than this is held at the prediction");
  fields("min_pairs", config.min_pairs, {3, 100000}, "fewer beams that hit walls make no match");
  fields.section("protection", config.protection);
}

MatchResult match_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls, const Pose2& guess,
                        double prior_m, const WallsConfig& config, WallsScratch& scratch) {
  const VectorLoop loop = fastest_vector_loop();
  WallsConfig believed = config;
  double noise_m = std::hypot(config.sigma_m, config.map_sigma_m);
  bool is_map_blamed = false;
  MatchResult result;
  result.map_from_laser = guess;
  double gate_m = std::clamp(4.0 * prior_m, std::max(config.near_gate_m, config.cut_sigma * noise_m),
                             std::max(config.gate_m, config.cut_sigma * noise_m));
  for (int round = 1; round <= kRounds; ++round) {
    // 1. Which wall every beam hits, as seen from where the laser is thought to be.
    const Pose2 before = result.map_from_laser;
    const WallPairing pairing = pair_with_walls(points, walls, before, gate_m, believed, scratch.beams, loop);
    result.on_map_ratio = pairing.on_map_ratio;
    result.misfit = pairing.misfit;
    result.pair_count = static_cast<int>(scratch.beams.count);
    if (result.pair_count < config.min_pairs) {
      result.map_from_laser = guess;
      result.status = MatchStatus::too_few_pairs;
      return result;
    }
    // 2. The pose from which they hit them best.
    const double still_m = kMoved_sigma * noise_m;
    const Fit fit = descend(gate_m / (config.cut_sigma * noise_m), still_m, round > 1, config, loop, scratch);
    const Observability seen(fit.sums.hessian, arm_of(fit.sums), fit.scale, config.unobservable_sigma_m);
    result.map_from_laser = before * fit.step;
    const double map_sigma_m = std::hypot(believed.map_sigma_m, std::sqrt(pairing.wall_variance_m2));
    result.covariance = covariance_of(fit, seen, before, map_sigma_m);
    result.rank = 3 - seen.weak_count;
    const Eigen::Vector3d weak = seen.directions.col(0).normalized();
    result.weak_direction << before.rotation() * weak.head<2>(), weak.z();
    result.scale_m = fit.scale * noise_m;
    result.iterations += fit.iterations;
    result.status = MatchStatus::converged;
    // 3. Pairs that were made from too far away, or too generously, are made again.
    const double next_gate_m =
        std::min(gate_m, std::max(config.near_gate_m, config.cut_sigma * result.scale_m));
    const bool has_moved = moved_m(fit) > still_m;
    const bool is_settled = !has_moved && next_gate_m > 0.8 * gate_m;
    // 4. What scatters more than the laser does is the map: its walls are off across, not along the beams.
    const double by_chance = kByChance / std::sqrt(static_cast<double>(result.pair_count));
    const bool is_off = fit.scale > 1.0 + by_chance && !is_map_blamed;
    const bool is_last = (is_settled && !is_off) || round == kRounds;
    if (is_last && result.rank == 3)
      result.protection = protect_walls(
          points, walls, left_behind(fit, before, map_sigma_m, config, loop, scratch), config, scratch);
    if (is_settled && !is_off) break;
    if (is_settled) {
      const double off_m = kAcross * noise_m * std::sqrt(fit.scale * fit.scale - 1.0);
      believed.map_sigma_m = std::hypot(believed.map_sigma_m, off_m);
      noise_m = std::hypot(noise_m, off_m);
      is_map_blamed = true;
    }
    gate_m = next_gate_m;
    result.status = MatchStatus::max_iterations;
  }
  return result;
}

}  // namespace beaconless
