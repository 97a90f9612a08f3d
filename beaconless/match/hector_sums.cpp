// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/hector_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

namespace beaconless {
namespace {

constexpr double kFarthest_m = 1e4;
constexpr double kFarthest_cells = 4e6;
constexpr float kOutside_m = 1e6F;  // where points that fill up the last lanes are
constexpr float kSteps = static_cast<float>(OccupancyLevel::kSteps);
constexpr double kPerStep = 1.0 / OccupancyLevel::kSteps;

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
  float low_y;
  std::int32_t last_column;
  std::int32_t last_row;
  float cap;  // residuals above it count as much as it
};

/// What it finds, in steps of values and cells; the last two on demand.
struct LoopSums {
  std::array<double, 6> hessian;  // xx, xy, yy, xt, yt, tt
  std::array<double, 3> gradient;
  int near_count;
  double misfit;
  double pull;
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

/// Nothing for a grid absurdly far away: whole numbers of cells have to be exact in floats.
std::optional<LoopInput> input_of(const HectorPoints& points, const OccupancyLevel& level,
                                  const Pose2& grid_from_laser, double least) {
  const double cells = 1.0 / level.resolution_m();
  const Eigen::Vector2d laser = cells * grid_from_laser.translation() - Eigen::Vector2d(0.5, 0.5);
  const Eigen::Vector2d corner = laser.array().floor();
  const Eigen::Vector2d low = Eigen::Vector2d(level.low().x - 2.0, level.low().y - 2.0) - corner;
  const Eigen::Vector2d high = low + Eigen::Vector2d(level.stride(), level.rows());
  if (!(std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()) < kFarthest_cells)) return {};
  return LoopInput{
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
      .low_y = static_cast<float>(low.y()),
      .last_column = level.stride() - 1,
      .last_row = level.rows() - 1,
      .cap = static_cast<float>((1.0 - least) * OccupancyLevel::kSteps),
  };
}

template <bool kTells>
LoopSums run(const LoopInput& in, [[maybe_unused]] VectorLoop loop) {
  LoopSums sums{};
#ifdef HECTOR_HAS_AVX2
  if (loop == VectorLoop::avx2) {
    eight_lanes::sum_lanes<kTells>(in, sums);
    return sums;
  }
#endif
  four_lanes::sum_lanes<kTells>(in, sums);
  return sums;
}

}  // namespace

void HectorPoints::load(std::span<const Eigen::Vector2d> points) {
  const std::size_t room = (points.size() + kLanes - 1) / kLanes * kLanes;
  x_m.resize(room);
  y_m.resize(room);
  count = 0;
  double squares = 0.0;
  for (const Eigen::Vector2d& point : points) {
    const bool is_usable = std::abs(point.x()) <= kFarthest_m && std::abs(point.y()) <= kFarthest_m;
    x_m[count] = static_cast<float>(point.x());
    y_m[count] = static_cast<float>(point.y());
    squares += is_usable ? point.squaredNorm() : 0.0;
    count += is_usable ? 1 : 0;
  }
  arm_m = count == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(count));
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  x_m.resize(whole);
  y_m.resize(whole);
  std::fill(x_m.begin() + static_cast<std::ptrdiff_t>(count), x_m.end(), kOutside_m);
  std::fill(y_m.begin() + static_cast<std::ptrdiff_t>(count), y_m.end(), kOutside_m);
}

HectorSums sum_hector(const HectorPoints& points, const OccupancyLevel& level, const Pose2& grid_from_laser,
                      VectorLoop loop) {
  const auto in = input_of(points, level, grid_from_laser, 0.0);
  if (!in) return {};
  const LoopSums sums = run<false>(*in, loop);
  const double length_m = level.resolution_m();
  const Eigen::Vector3d scale = kPerStep * Eigen::Vector3d(1.0, 1.0, length_m);
  const auto& [xx, xy, yy, xt, yt, tt] = sums.hessian;
  HectorSums out;
  out.hessian << xx, xy, xt, xy, yy, yt, xt, yt, tt;
  out.hessian = scale.asDiagonal() * out.hessian * scale.asDiagonal();
  out.gradient = length_m * kPerStep *
                 scale.cwiseProduct(Eigen::Vector3d(sums.gradient[0], sums.gradient[1], sums.gradient[2]));
  out.near_count = sums.near_count;
  return out;
}

HectorFit fit_hector(const HectorPoints& points, const OccupancyLevel& level, const Pose2& grid_from_laser,
                     double least, VectorLoop loop) {
  const auto in = input_of(points, level, grid_from_laser, least);
  if (!in) return {.misfit_sum = static_cast<double>(points.count)};
  const LoopSums sums = run<true>(*in, loop);
  const auto cap = static_cast<double>(in->cap);
  const double length_m = level.resolution_m();
  const auto only_fill_up = static_cast<double>(points.x_m.size() - points.count);
  return {.near_count = sums.near_count,
          .misfit_sum = sums.misfit / (cap * cap) - only_fill_up,
          .pull_m2 = length_m * length_m * kPerStep * kPerStep * kPerStep * kPerStep * sums.pull,
          .slope_sum = kPerStep * kPerStep * (sums.hessian[0] + sums.hessian[2])};
}

}  // namespace beaconless
