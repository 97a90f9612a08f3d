// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_beams.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace beaconless {
namespace {

constexpr double kFar_m = 1e100;  // beyond any cut, and its square still a number

struct LoopInput {
  double x;
  double y;
  double cos;
  double sin;
  double inverse_cut2;
};

struct LoopSums {
  std::array<double, 6> hessian;  // xx, xy, yy, xt, yt, tt
  std::array<double, 3> gradient;
  double weight;
  double weighted_squares;
  double squared_influence;
  double curvature;
  double arms;
};

namespace two_lanes {
#define WALL_LANES 2
#define WALL_TARGET
#include "beaconless/match/wall_lanes.inc"
#undef WALL_LANES
#undef WALL_TARGET
}  // namespace two_lanes

#if defined(__x86_64__) || defined(__i386__)
#define WALL_HAS_AVX2
namespace four_lanes {
#define WALL_LANES 4
#define WALL_TARGET __attribute__((target("avx2,fma")))
#include "beaconless/match/wall_lanes.inc"
#undef WALL_LANES
#undef WALL_TARGET
}  // namespace four_lanes
#endif

}  // namespace

void WallBeams::reserve(std::size_t beams) {
  const std::size_t room = (beams + kLanes - 1) / kLanes * kLanes;
  if (room <= x_m.size()) return;
  starts.resize(room);
  for (auto* column : {&x_m, &y_m, &ux, &uy, &nx, &ny, &offset_m, &information}) column->resize(room);
}

void WallBeams::fill_up() {
  const std::size_t all = (count + kLanes - 1) / kLanes * kLanes;
  for (std::size_t i = count; i < all; ++i) {
    x_m[i] = y_m[i] = uy[i] = ny[i] = 0.0;
    ux[i] = nx[i] = information[i] = 1.0;
    offset_m[i] = kFar_m;
  }
}

WallSums sum_walls(const WallBeams& beams, const Pose2& step, double cut, [[maybe_unused]] VectorLoop loop,
                   WallMarks* marks) {
  const LoopInput in{step.x_m, step.y_m, std::cos(step.theta_rad), std::sin(step.theta_rad),
                     1.0 / (cut * cut)};
  LoopSums sums{};
#ifdef WALL_HAS_AVX2
  if (loop == VectorLoop::avx2)
    four_lanes::sum_lanes(beams, in, marks, sums);
  else
#endif
    two_lanes::sum_lanes(beams, in, marks, sums);
  const auto& [xx, xy, yy, xt, yt, tt] = sums.hessian;
  WallSums out;
  out.hessian << xx, xy, xt, xy, yy, yt, xt, yt, tt;
  out.gradient = {sums.gradient[0], sums.gradient[1], sums.gradient[2]};
  out.weight = sums.weight;
  out.weighted_squares = sums.weighted_squares;
  out.squared_influence = sums.squared_influence;
  out.curvature = sums.curvature;
  out.arm_squares_m2 = sums.arms;
  return out;
}

}  // namespace beaconless
