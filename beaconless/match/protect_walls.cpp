// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/protect_walls.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/match/wall_pairs.hpp"

namespace beaconless {
namespace {

constexpr double kLeftOut = 0.2;  // over the root of the beams: 2.5 standard deviations of the mean weight
constexpr std::size_t kThinned = 4;
constexpr double kFar_gates = 2.0;
constexpr double kCut_gates = 2.0;  // so wide a cut that a beam at the gate still has half its weight
constexpr int kTimes = 3;           // that beams are paired, each from where the one before went furthest …
constexpr double kSame_m = 0.01;    // … unless that is here …
constexpr double kElsewhere_m = 1.0;  // … or so far away that other walls are hit

/// The mean of Tukey's weights for a Gaussian of one standard deviation.
double expected_weight(double cut) { return 1.0 - 2.0 / (cut * cut) + 3.0 / (cut * cut * cut * cut); }

/// The mean square of how far pieces of walls are off, in variances of a beam.
double scatter_of(std::span<const WallPiece> pieces, std::size_t beams) {
  double squares = 0.0;
  for (const WallPiece& piece : pieces) {
    const double pull = piece.nx * piece.sums.gradient[0] + piece.ny * piece.sums.gradient[1];
    if (piece.sums.across() > 0.0) squares += pull * pull / piece.sums.across();
  }
  return squares / static_cast<double>(std::max<std::size_t>(beams, 1));
}

/// The parts of thinned beams, wherever they end near a wall as seen from a pose. Raises what noise is.
Separated separate_all(const WallIndex& walls, const Pose2& seen_from, const WallsConfig& config,
                       SeparatedFit& fit, WallsScratch& scratch) {
  const VectorLoop loop = fastest_vector_loop();
  const double gate_m = kFar_gates * config.gate_m;
  pair_with_walls(scratch.thinned, walls, seen_from, gate_m, config, scratch.beams, loop);
  divide(scratch.beams, loop, scratch.marks, scratch.pieces);
  sum_walls(scratch.beams, {}, kCut_gates * gate_m / config.sigma_m, loop, &scratch.marks);
  add_up(scratch.marks, scratch.pieces);
  fit.variance_factor = std::max(fit.variance_factor, scatter_of(scratch.pieces, scratch.beams.count));
  return separate_walls(fit, config.protection, scratch.pieces, scratch.lines, false);
}

}  // namespace

ProtectionLevel protect_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                              const FittedWalls& fit, const WallsConfig& config, WallsScratch& scratch) {
  // 1. By the beams as they were weighed.
  ProtectionLevel level =
      separate_walls(fit.known, config.protection, scratch.pieces, scratch.lines, true).level;
  const auto count = static_cast<double>(points.size());
  const double least = expected_weight(config.cut_sigma) * count - kLeftOut * std::sqrt(count);
  if (fit.weight > least || !level.is_bounded()) return level;
  // 2. By all that end near a wall, as seen from the fit and from where the furthest of its parts put it.
  scratch.thinned.clear();
  for (std::size_t i = 0; i < points.size(); i += kThinned) scratch.thinned.push_back(points[i]);
  SeparatedFit alike = fit.known;
  alike.curvature = 1.0;
  alike.last_step.setZero();
  for (int time = 0; time < kTimes && level.is_bounded(); ++time) {
    const Eigen::Vector3d from = -alike.last_step;
    const Pose2 seen_from = fit.paired_at * fit.step * Pose2{from.x(), from.y(), from.z()};
    const Separated told = separate_all(walls, seen_from, config, alike, scratch);
    // From elsewhere only what still tells a pose counts.
    if (time > 0 && !told.level.is_bounded()) break;
    level.position_m = std::max(level.position_m, told.level.position_m);
    level.heading_rad = std::max(level.heading_rad, told.level.heading_rad);
    const Eigen::Vector3d to(told.furthest.dx_m, told.furthest.dy_m, told.furthest.dtheta_rad);
    if ((to - from).head<2>().norm() < kSame_m || to.head<2>().norm() > kElsewhere_m) break;
    alike.last_step = -to;
  }
  return level;
}

}  // namespace beaconless
