// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hector_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace beaconless {
namespace {

constexpr double kFarthest_m = 1e4;
constexpr double kFarthest_cells = 4e6;
constexpr float kOutside_m = 1e6F;  // where points that fill up the last lanes are
constexpr float kSteps = static_cast<float>(OccupancyLevel::kSteps);

/// What the loop over the points reads. Places are in cells, counted between middles of cells from the one at
/// or below the laser, so that floats resolve them however large the grid is.
struct LoopInput {
  const float* x_m;
  const float* y_m;
  std::size_t count;
  const std::uint32_t* stencils;
  std::int32_t stride;
  float cos;  // times the cells of a metre
  float sin;
  float laser_x;  // in [0, 1)
  float laser_y;
  float low_x;  // of the stencils
  float high_x;
  float low_y;
  float high_y;
  float cap;  // residuals above it count as much as it
};

/// What it finds, in steps of values.
struct LoopSums {
  std::array<double, 6> hessian;  // xx, xy, yy, xt, yt, tt
  std::array<double, 3> gradient;
  double cost;
  int near_count;
};

namespace four_lanes {
#define HECTOR_LANES 4
#define HECTOR_TARGET
#include "beaconless/match/hector_lanes.inc"
#undef HECTOR_LANES
#undef HECTOR_TARGET
}  // namespace four_lanes

#if defined(__x86_64__) || defined(__i386__)
#define HECTOR_HAS_AVX2
namespace eight_lanes {
#define HECTOR_LANES 8
#define HECTOR_TARGET __attribute__((target("avx2,fma")))
#include "beaconless/match/hector_lanes.inc"
#undef HECTOR_LANES
#undef HECTOR_TARGET
}  // namespace eight_lanes
#endif

}  // namespace

void HectorPoints::load(std::span<const Eigen::Vector2d> points) {
  x_m.clear();
  y_m.clear();
  const std::size_t room = points.size() + kLanes;
  x_m.reserve(room);
  y_m.reserve(room);
  double squares = 0.0;
  for (const Eigen::Vector2d& point : points) {
    if (!(point.cwiseAbs().maxCoeff() <= kFarthest_m)) continue;
    x_m.push_back(static_cast<float>(point.x()));
    y_m.push_back(static_cast<float>(point.y()));
    squares += point.squaredNorm();
  }
  count = x_m.size();
  arm_m = count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  x_m.resize(whole, kOutside_m);
  y_m.resize(whole, kOutside_m);
}

HectorLoop fastest_hector_loop() {
#ifdef HECTOR_HAS_AVX2
  static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has_avx2 ? HectorLoop::avx2 : HectorLoop::portable;
#else
  return HectorLoop::portable;
#endif
}

HectorSums sum_hector(const HectorPoints& points, const OccupancyLevel& level, const Pose2& grid_from_laser,
                      double least, [[maybe_unused]] HectorLoop loop) {
  // 1. Where the laser is between the middles of cells, and the stencils from there. Whole numbers of cells
  // are exact in floats as long as the grid is not absurdly far away.
  const double cells = 1.0 / level.resolution_m();
  const Eigen::Vector2d laser = cells * grid_from_laser.translation() - Eigen::Vector2d(0.5, 0.5);
  const Eigen::Vector2d corner = laser.array().floor();
  const Eigen::Vector2d low = Eigen::Vector2d(level.low().x - 2.0, level.low().y - 2.0) - corner;
  const Eigen::Vector2d high = Eigen::Vector2d(level.high().x + 1.0, level.high().y + 1.0) - corner;
  if (!(std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()) < kFarthest_cells))
    return {.cost = static_cast<double>(points.count)};
  const LoopInput in{
      .x_m = points.x_m.data(),
      .y_m = points.y_m.data(),
      .count = points.x_m.size(),
      .stencils = level.stencils().data(),
      .stride = level.stride(),
      .cos = static_cast<float>(cells * std::cos(grid_from_laser.theta_rad)),
      .sin = static_cast<float>(cells * std::sin(grid_from_laser.theta_rad)),
      .laser_x = static_cast<float>(laser.x() - corner.x()),
      .laser_y = static_cast<float>(laser.y() - corner.y()),
      .low_x = static_cast<float>(low.x()),
      .high_x = static_cast<float>(high.x()),
      .low_y = static_cast<float>(low.y()),
      .high_y = static_cast<float>(high.y()),
      .cap = static_cast<float>((1.0 - least) * OccupancyLevel::kSteps),
  };

  // 2. The loop.
  LoopSums sums{};
#ifdef HECTOR_HAS_AVX2
  if (loop == HectorLoop::avx2)
    eight_lanes::sum_lanes(in, sums);
  else
#endif
    four_lanes::sum_lanes(in, sums);

  // 3. From steps and cells to metres, without the points that only fill up lanes.
  const double length_m = level.resolution_m();
  const double per_step = 1.0 / OccupancyLevel::kSteps;
  const Eigen::Vector3d scale = per_step * Eigen::Vector3d(1.0, 1.0, length_m);
  const auto& [xx, xy, yy, xt, yt, tt] = sums.hessian;
  HectorSums out;
  out.hessian << xx, xy, xt, xy, yy, yt, xt, yt, tt;
  out.hessian = scale.asDiagonal() * out.hessian * scale.asDiagonal();
  out.gradient = length_m * per_step *
                 scale.cwiseProduct(Eigen::Vector3d(sums.gradient[0], sums.gradient[1], sums.gradient[2]));
  const double cap = static_cast<double>(in.cap);
  out.cost = sums.cost / (cap * cap) - static_cast<double>(points.x_m.size() - points.count);
  out.near_count = sums.near_count;
  return out;
}

}  // namespace beaconless
