// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace beaconless {
namespace {

constexpr double kSlack_sigma = 0.5;  // by which a beam may miss the end of a wall
constexpr double kParallel = 1e-6;    // a beam meets no wall at a smaller angle
constexpr double kPlain_sigma = 3.0;  // this near to the wall of the beam before, a beam is on it too
constexpr double kFirst_sigma = 4.0;  // of two walls behind each other the first is taken up to here

/// Which walls a beam may be paired with.
struct Gate {
  double distance_m;
  double slack_m;  // beyond the ends of a wall
  double first_m;  // how far behind a wall, along the beam, its beams may end
  double least_cos;
};

/// One beam as seen from the pose, map frame.
struct Ray {
  double end_x;
  double end_y;
  double direction_x;
  double direction_y;
};

/// The wall that one beam hits.
struct Hit {
  const WallIndex::Wall* wall = nullptr;
  WallIndex::Stretch clear{};                                   // of the wall, around where it is hit
  double across = 0.0;                                          // sine from the wall to the beam
  double nearest_m2 = std::numeric_limits<double>::infinity();  // squared distance of the end to any wall
};

/// A beam beside a wall's line.
struct Beside {
  double along;   // where the end lies, from the wall's beginning
  double side;    // how far the end lies beside the line, positive to the left
  double across;  // sine from the wall to the beam
};

inline Beside beside(const WallIndex::Wall& wall, const Ray& ray) {
  const double from_x = ray.end_x - wall.a.x();
  const double from_y = ray.end_y - wall.a.y();
  return {wall.along.x() * from_x + wall.along.y() * from_y,
          wall.along.x() * from_y - wall.along.y() * from_x,
          wall.along.x() * ray.direction_y - wall.along.y() * ray.direction_x};
}

/// The wall that a beam meets nearest to where it ends; of two that it meets there, the first. One whose end
/// it misses by a little is met where no other is. A beam that grazes its wall is on no other one either.
inline Hit meet(const WallIndex& walls, const Ray& ray, const Gate& gate) {
  Hit best;
  double best_beyond_m = std::numeric_limits<double>::infinity();
  double best_along_m = 0.0;
  bool is_best_missed = false;
  for (const std::uint32_t id : walls.near({ray.end_x, ray.end_y})) {
    const WallIndex::Wall& wall = walls.wall(id);
    const auto [along, side, across] = beside(wall, ray);
    const double outside = std::max({0.0, -along, along - wall.length_m});
    best.nearest_m2 = std::min(best.nearest_m2, side * side + outside * outside);
    if (std::abs(side) > gate.distance_m || !(std::abs(across) >= kParallel)) continue;
    const double beyond = side / across;  // of the beam's end, along the beam
    const double at = along - beyond * (wall.along.x() * ray.direction_x + wall.along.y() * ray.direction_y);
    if (at < -gate.slack_m || at > wall.length_m + gate.slack_m) continue;
    const bool is_missed = at < 0.0 || at > wall.length_m;
    if (best.wall != nullptr && is_missed == is_best_missed) {
      const bool is_first = beyond > best_beyond_m && beyond < gate.first_m;
      const bool is_behind = beyond < best_beyond_m && best_beyond_m < gate.first_m;
      if (!is_first && (is_behind || std::abs(beyond) >= std::abs(best_beyond_m))) continue;
    } else if (best.wall != nullptr) {
      const double met_m = is_missed ? best_beyond_m : beyond;
      const double missed_m = is_missed ? beyond : best_beyond_m;
      const bool is_met = std::abs(met_m) < std::max(gate.first_m, std::abs(missed_m));
      if (is_met == is_missed) continue;
    }
    best_beyond_m = beyond;
    best_along_m = along;
    is_best_missed = is_missed;
    best.wall = &wall;
    best.across = across;
  }
  if (!(std::abs(best.across) >= gate.least_cos)) best.wall = nullptr;
  if (best.wall != nullptr) best.clear = walls.clear_around(*best.wall, best_along_m);
  return best;
}

/// Whether a beam plainly hits the wall that the beam before it hit: where no other wall is near, and nearer
/// to it than noise alone would have it. Then no other wall is looked up.
inline bool hits_again(Hit& hit, const Ray& ray, double near_m, double least_cos) {
  const auto [along, side, across] = beside(*hit.wall, ray);
  hit.across = across;
  hit.nearest_m2 = side * side;
  // |side| below near · |across| is |beyond| below near.
  return std::abs(side) < near_m * std::abs(across) && std::abs(across) > least_cos &&
         along > hit.clear.from_m && along < hit.clear.to_m;
}

/// What a range to a wall tells, as information.
class Knowledge {
 public:
  explicit Knowledge(const WallsConfig& config)
      : own_variance_(config.sigma_m * config.sigma_m),
        per_m2_(config.sigma_per_m * config.sigma_per_m),
        footprint2_(config.footprint_rad * config.footprint_rad),
        map_variance_(config.map_sigma_m * config.map_sigma_m),
        is_the_same_(per_m2_ == 0.0 && footprint2_ == 0.0 && map_variance_ == 0.0) {}

  /// Of one beam, or of several on one wall in lanes. Not returned: how lanes are depends on the processor.
  template <class Number>
  __attribute__((always_inline)) void tell(const Number& range_m, const Number& across, double wall_variance,
                                           Number& information) const {
    information = 1.0 / own_variance_ + Number{};
    if (is_the_same_ && wall_variance == 0.0) return;
    const Number inverse_cos2 = 1.0 / (across * across);
    const Number range2 = range_m * range_m;
    information = 1.0 / (own_variance_ + per_m2_ * range2 + footprint2_ * range2 * (inverse_cos2 - 1.0) +
                         (map_variance_ + wall_variance) * inverse_cos2);
  }

 private:
  double own_variance_;
  double per_m2_;
  double footprint2_;
  double map_variance_;
  bool is_the_same_;  // for all beams
};

/// What all beams of a scan are paired by.
struct PairingInput {
  double x;  // of the laser, map frame
  double y;
  double cos;
  double sin;
  Gate gate;
  double plain_m;
  double on_map_m2;
  double inverse_on_map_m2;
  Knowledge knowledge;
};

/// A wall as the laser's frame has it, its normal to the left: pointing away from a laser on the right.
struct Facing {
  Facing() = default;
  Facing(const WallIndex::Wall& wall, const PairingInput& in)
      : nx(in.sin * wall.along.x() - in.cos * wall.along.y()),
        ny(in.cos * wall.along.x() + in.sin * wall.along.y()),
        offset_m(wall.along.x() * (wall.a.y() - in.y) - wall.along.y() * (wall.a.x() - in.x)) {}

  double nx = 0.0;
  double ny = 0.0;
  double offset_m = 0.0;
};

/// Where beams are written to.
struct Columns {
  explicit Columns(WallBeams& beams)
      : x_m(beams.x_m.data()),
        y_m(beams.y_m.data()),
        ux(beams.ux.data()),
        uy(beams.uy.data()),
        nx(beams.nx.data()),
        ny(beams.ny.data()),
        offset_m(beams.offset_m.data()),
        information(beams.information.data()),
        starts(beams.starts.data()) {}

  double* x_m;
  double* y_m;
  double* ux;
  double* uy;
  double* nx;
  double* ny;
  double* offset_m;
  double* information;
  std::uint32_t* starts;
};

/// The beams that lie on the map, summed up.
struct OnMap {
  double fit = 0.0;
  std::int64_t count = 0;
  double wall_variance = 0.0;  // of all beams that hit a wall, summed up
};

namespace two_lanes {
#define WALL_LANES 2
#define WALL_TARGET
#include "beaconless/match/wall_pair_lanes.inc"
#undef WALL_LANES
#undef WALL_TARGET
}  // namespace two_lanes

#if defined(__x86_64__) || defined(__i386__)
#define WALL_HAS_AVX2
namespace four_lanes {
#define WALL_LANES 4
#define WALL_TARGET __attribute__((target("avx2,fma")))
#include "beaconless/match/wall_pair_lanes.inc"
#undef WALL_LANES
#undef WALL_TARGET
}  // namespace four_lanes
#endif

}  // namespace

WallPairing pair_with_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                            const Pose2& map_from_laser, double gate_m, const WallsConfig& config,
                            WallBeams& beams, [[maybe_unused]] VectorLoop loop) {
  const double on_map_m2 = config.on_map_m * config.on_map_m;
  const PairingInput in{
      .x = map_from_laser.x_m,
      .y = map_from_laser.y_m,
      .cos = std::cos(map_from_laser.theta_rad),
      .sin = std::sin(map_from_laser.theta_rad),
      .gate = {gate_m, std::max(kSlack_sigma * config.sigma_m, 0.3 * (gate_m - config.near_gate_m)),
               std::max(kFirst_sigma * config.sigma_m, 0.3 * gate_m),
               std::cos(radians(config.max_incidence_deg))},
      .plain_m = kPlain_sigma * config.sigma_m,
      .on_map_m2 = on_map_m2,
      .inverse_on_map_m2 = 1.0 / on_map_m2,
      .knowledge = Knowledge(config),
  };
  beams.clear();
  beams.reserve(points.size());
#ifdef WALL_HAS_AVX2
  const OnMap on_map = loop == VectorLoop::avx2 ? four_lanes::pair_lanes(points, walls, in, beams)
                                                : two_lanes::pair_lanes(points, walls, in, beams);
#else
  const OnMap on_map = two_lanes::pair_lanes(points, walls, in, beams);
#endif
  beams.fill_up();
  const double all = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return {static_cast<double>(on_map.count) / all, 1.0 - on_map.fit / all,
          on_map.wall_variance / static_cast<double>(std::max<std::size_t>(beams.count, 1))};
}

}  // namespace beaconless
