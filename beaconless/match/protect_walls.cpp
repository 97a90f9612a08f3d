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
constexpr double kAlike = 1e6;  // a cut so wide that all weights are 1

/// The mean of Tukey's weights for a Gaussian of one standard deviation.
double expected_weight(double cut) { return 1.0 - 2.0 / (cut * cut) + 3.0 / (cut * cut * cut * cut); }

/// The mean square of how far pieces of walls are off, in variances of a beam.
double scatter_of(std::span<const WallPiece> pieces, std::size_t beams) {
  double squares = 0.0;
  for (const WallPiece& piece : pieces) {
    const double pull = piece.nx * piece.sums.gradient[0] + piece.ny * piece.sums.gradient[1];
    squares += pull * pull / piece.sums.across;
  }
  return squares / static_cast<double>(std::max<std::size_t>(beams, 1));
}

}  // namespace

ProtectionLevel protect_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                              const FittedWalls& fit, const WallsConfig& config, WallsScratch& scratch) {
  const VectorLoop loop = fastest_vector_loop();
  // 1. By the beams as they were weighed.
  sum_pieces(scratch.beams, fit.step, fit.cut, loop, scratch.pieces);
  ProtectionLevel level = separate_walls(fit.known, config.protection, scratch.pieces, scratch.lines, true);
  const auto count = static_cast<double>(points.size());
  const double least = expected_weight(config.cut_sigma) * count - kLeftOut * std::sqrt(count);
  if (fit.weight > least || !level.is_bounded()) return level;
  // 2. By all that end near a wall.
  scratch.thinned.clear();
  for (std::size_t i = 0; i < points.size(); i += kThinned) scratch.thinned.push_back(points[i]);
  pair_with_walls(scratch.thinned, walls, fit.paired_at * fit.step, kFar_gates * config.gate_m, config,
                  scratch.beams, loop);
  sum_pieces(scratch.beams, {}, kAlike, loop, scratch.pieces);
  SeparatedFit alike = fit.known;
  alike.curvature = 1.0;
  alike.variance_factor = std::max(alike.variance_factor, scatter_of(scratch.pieces, scratch.beams.count));
  const ProtectionLevel of_all =
      separate_walls(alike, config.protection, scratch.pieces, scratch.lines, false);
  level.position_m = std::max(level.position_m, of_all.position_m);
  level.heading_rad = std::max(level.heading_rad, of_all.heading_rad);
  return level;
}

}  // namespace beaconless
