// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/field_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace beaconless {
namespace {

constexpr std::size_t kBlock = 64;  // beams whose places are found before any is looked up

/// The table, and the ends of beams, as the loop reads them.
struct FieldInput {
  const float* x_m;
  const float* y_m;
  std::size_t count;
  const std::uint8_t* bytes;
  float last_column;
  float last_row;
  std::int32_t stride;
};

/// A particle: where its laser stands in the table (cells), and the turn times the cells of a metre.
struct FieldPose {
  float x;
  float y;
  float cos;
  float sin;
};

/// A loop that the compiler turns into lanes of the target that calls it. Comparisons are such that NaN goes
/// to the rim.
__attribute__((always_inline)) inline std::int32_t sum_of(const FieldInput& in, const FieldPose& pose) {
  alignas(64) std::array<std::int32_t, kBlock> places;  // NOLINT(*-member-init): filled before it is read
  std::int32_t sum = 0;
  for (std::size_t first = 0; first < in.count; first += kBlock) {
    const std::size_t size = std::min(kBlock, in.count - first);
    const float* const x = in.x_m + first;
    const float* const y = in.y_m + first;
    for (std::size_t i = 0; i < size; ++i) {
      float column = pose.x + (pose.cos * x[i] - pose.sin * y[i]);
      float row = pose.y + (pose.sin * x[i] + pose.cos * y[i]);
      column = column > 0.0F ? column : 0.0F;
      column = column < in.last_column ? column : in.last_column;
      row = row > 0.0F ? row : 0.0F;
      row = row < in.last_row ? row : in.last_row;
      places[i] = static_cast<std::int32_t>(row) * in.stride + static_cast<std::int32_t>(column);
    }
    for (std::size_t i = 0; i < size; ++i) sum += in.bytes[places[i]];
  }
  return sum;
}

__attribute__((always_inline)) inline void sum_all(const FieldInput& in, const FieldPose* poses,
                                                   std::size_t count, std::int32_t* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] = sum_of(in, poses[i]);
}

void sum_portable(const FieldInput& in, const FieldPose* poses, std::size_t count, std::int32_t* sums) {
  sum_all(in, poses, count, sums);
}

#if defined(__x86_64__) || defined(__i386__)
#define FIELD_HAS_AVX2
__attribute__((target("avx2,fma"))) void sum_avx2(const FieldInput& in, const FieldPose* poses,
                                                  std::size_t count, std::int32_t* sums) {
  sum_all(in, poses, count, sums);
}
#endif

}  // namespace

bool has_wide_lanes() {
#ifdef FIELD_HAS_AVX2
  static const bool kHas = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return kHas;
#else
  return false;
#endif
}

void sum_field(const Particles& particles, const Pose2& base_from_laser, const BeamEnds& ends,
               const LikelihoodField& field, std::vector<std::int32_t>& sums, [[maybe_unused]] bool wide) {
  const double cells = 1.0 / field.cell_m();
  const FieldInput in{ends.x_m.data(),
                      ends.y_m.data(),
                      ends.size(),
                      field.bytes().data(),
                      static_cast<float>(field.width_cells() - 1),
                      static_cast<float>(field.height_cells() - 1),
                      field.width_cells()};
  const Pose2 base_from_turned_laser{base_from_laser.x_m, base_from_laser.y_m, 0.0};
  const double turn_c = std::cos(base_from_laser.theta_rad);
  const double turn_s = std::sin(base_from_laser.theta_rad);
  sums.resize(particles.size());
  std::array<FieldPose, kBlock> poses;  // NOLINT(*-member-init): the same
  for (std::size_t first = 0; first < particles.size(); first += kBlock) {
    const std::size_t size = std::min(kBlock, particles.size() - first);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t of = first + i;
      const double c = std::cos(particles.theta_rad[of]);
      const double s = std::sin(particles.theta_rad[of]);
      const Pose2& arm = base_from_turned_laser;
      poses[i] = {
          static_cast<float>(cells * (particles.x_m[of] + c * arm.x_m - s * arm.y_m - field.low().x())),
          static_cast<float>(cells * (particles.y_m[of] + s * arm.x_m + c * arm.y_m - field.low().y())),
          static_cast<float>(cells * (c * turn_c - s * turn_s)),
          static_cast<float>(cells * (s * turn_c + c * turn_s))};
    }
#ifdef FIELD_HAS_AVX2
    if (wide) {
      sum_avx2(in, poses.data(), size, sums.data() + first);
      continue;
    }
#endif
    sum_portable(in, poses.data(), size, sums.data() + first);
  }
}

}  // namespace beaconless
