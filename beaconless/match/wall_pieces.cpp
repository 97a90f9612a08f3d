// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace beaconless {
namespace {

struct LoopInput {
  double x;
  double y;
  double cos;
  double sin;
  double inverse_cut2;
};

/// What the beams of a piece have in common.
struct Key {
  double nx = 0.0;
  double ny = 0.0;
  double offset_m = 0.0;
  int octant = 0;

  friend bool operator==(const Key&, const Key&) = default;
};

/// Over the beams of a piece, with W = w / (variance cos²), τ the lever of a turn and f the way beyond the
/// wall, across it.
struct LineSums {
  double a = 0.0;  // Σ W
  double b = 0.0;  // Σ W τ
  double c = 0.0;  // Σ W τ²
  double d = 0.0;  // Σ W f
  double e = 0.0;  // Σ W τ f
};

inline int octant_of(double ux, double uy) {
  return (ux < 0.0 ? 1 : 0) | (uy < 0.0 ? 2 : 0) | (std::abs(uy) > std::abs(ux) ? 4 : 0);
}

void finish(const Key& key, const LineSums& of, std::vector<WallPiece>& pieces) {
  if (!(of.a > 0.0)) return;
  pieces.push_back({key.nx,
                    key.ny,
                    key.offset_m,
                    key.octant,
                    {{key.nx * key.nx * of.a, key.nx * key.ny * of.a, key.ny * key.ny * of.a, key.nx * of.b,
                      key.ny * of.b, of.c},
                     {key.nx * of.d, key.ny * of.d, of.e},
                     of.a}});
}

namespace two_lanes {
#define WALL_LANES 2
#define WALL_TARGET
#include "beaconless/match/wall_piece_lanes.inc"
#undef WALL_LANES
#undef WALL_TARGET
}  // namespace two_lanes

#if defined(__x86_64__) || defined(__i386__)
#define WALL_HAS_AVX2
namespace four_lanes {
#define WALL_LANES 4
#define WALL_TARGET __attribute__((target("avx2,fma")))
#include "beaconless/match/wall_piece_lanes.inc"
#undef WALL_LANES
#undef WALL_TARGET
}  // namespace four_lanes
#endif

}  // namespace

void sum_pieces(const WallBeams& beams, const Pose2& step, double cut, [[maybe_unused]] VectorLoop loop,
                std::vector<WallPiece>& pieces) {
  const LoopInput in{step.x_m, step.y_m, std::cos(step.theta_rad), std::sin(step.theta_rad),
                     1.0 / (cut * cut)};
  pieces.clear();
#ifdef WALL_HAS_AVX2
  if (loop == VectorLoop::avx2)
    four_lanes::sum_lanes(beams, in, pieces);
  else
#endif
    two_lanes::sum_lanes(beams, in, pieces);
}

}  // namespace beaconless
