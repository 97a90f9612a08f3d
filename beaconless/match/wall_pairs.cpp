// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace beaconless {
namespace {

constexpr double kSlack_m = 0.005;    // by which a beam may miss the end of a wall
constexpr double kPlain_sigma = 3.0;  // this near to the wall of the beam before, a beam is on it too
constexpr double kFirst_sigma = 4.0;  // of two walls behind each other the first is taken up to here

/// Which walls a beam may be paired with.
struct Gate {
  double distance_m;
  double slack_m;  // beyond the ends of a wall
  double first_m;  // how far behind a wall, along the beam, its beams may end
  double least_cos;
};

/// The wall that one beam hits.
struct Hit {
  const WallIndex::Wall* wall = nullptr;
  double across = 0.0;                                          // sine from the wall to the beam
  double nearest_m2 = std::numeric_limits<double>::infinity();  // squared distance of the end to any wall
};

/// A beam beside a wall's line.
struct Beside {
  double along;   // where the end lies, from the wall's beginning
  double side;    // how far the end lies beside the line, positive to the left
  double across;  // sine from the wall to the beam
};

inline Beside beside(const WallIndex::Wall& wall, const WallsScratch::Ray& ray) {
  const double from_x = ray.end.x() - wall.a.x();
  const double from_y = ray.end.y() - wall.a.y();
  return {wall.along.x() * from_x + wall.along.y() * from_y,
          wall.along.x() * from_y - wall.along.y() * from_x,
          wall.along.x() * ray.direction.y() - wall.along.y() * ray.direction.x()};
}

/// The wall that a beam meets nearest to where it ends; of two that it meets there, the first.
inline Hit meet(const WallIndex& walls, const WallsScratch::Ray& ray, const Gate& gate) {
  Hit best;
  double best_beyond_m = std::numeric_limits<double>::infinity();
  for (const std::uint32_t id : walls.near(ray.end)) {
    const WallIndex::Wall& wall = walls.wall(id);
    const auto [along, side, across] = beside(wall, ray);
    const double outside = std::max({0.0, -along, along - wall.length_m});
    best.nearest_m2 = std::min(best.nearest_m2, side * side + outside * outside);
    if (std::abs(side) > gate.distance_m || std::abs(across) < gate.least_cos) continue;
    const double beyond = side / across;  // of the beam's end, along the beam
    const double at =
        along - beyond * (wall.along.x() * ray.direction.x() + wall.along.y() * ray.direction.y());
    if (at < -gate.slack_m || at > wall.length_m + gate.slack_m) continue;
    const bool is_first = beyond > best_beyond_m && beyond < gate.first_m;
    const bool is_behind = beyond < best_beyond_m && best_beyond_m < gate.first_m;
    if (best.wall != nullptr && !is_first && (is_behind || std::abs(beyond) >= std::abs(best_beyond_m)))
      continue;
    best_beyond_m = beyond;
    best.wall = &wall;
    best.across = across;
  }
  return best;
}

/// Whether a beam plainly hits the wall that the beam before it hit: well within its ends, and nearer to it
/// than noise alone would have it. Then no other wall is looked up.
inline bool hits_again(Hit& hit, const WallsScratch::Ray& ray, double near_m, double least_cos) {
  const auto [along, side, across] = beside(*hit.wall, ray);
  hit.across = across;
  hit.nearest_m2 = side * side;
  // |side| below near · |across| is |beyond| below near; the way along the wall is then below near too.
  return std::abs(side) < near_m * std::abs(across) && std::abs(across) > least_cos && along > near_m &&
         along < hit.wall->length_m - near_m;
}

/// Every beam as seen from a pose: where it ends and where it goes.
void look(std::span<const Eigen::Vector2d> points, const Pose2& pose, std::vector<WallsScratch::Ray>& rays) {
  const double cos = std::cos(pose.theta_rad);
  const double sin = std::sin(pose.theta_rad);
  if (rays.size() < points.size()) rays.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x();
    const double y = points[i].y();
    const double range = std::sqrt(x * x + y * y);
    const double inverse = 1.0 / range;
    WallsScratch::Ray& ray = rays[i];
    ray.unit = {x * inverse, y * inverse};
    ray.direction = {cos * ray.unit.x() - sin * ray.unit.y(), sin * ray.unit.x() + cos * ray.unit.y()};
    ray.end = {pose.x_m + cos * x - sin * y, pose.y_m + sin * x + cos * y};
    ray.range_m = range;
  }
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

  double of(double range_m, double across) const {
    if (is_the_same_) return 1.0 / own_variance_;
    const double inverse_cos2 = 1.0 / (across * across);
    const double range2 = range_m * range_m;
    return 1.0 / (own_variance_ + per_m2_ * range2 + footprint2_ * range2 * (inverse_cos2 - 1.0) +
                  map_variance_ * inverse_cos2);
  }

 private:
  double own_variance_;
  double per_m2_;
  double footprint2_;
  double map_variance_;
  bool is_the_same_;  // for all beams
};

}  // namespace

WallPairing pair_with_walls(std::span<const Eigen::Vector2d> points, const WallIndex& walls,
                            const Pose2& map_from_laser, double gate_m, const WallsConfig& config,
                            WallsScratch& scratch) {
  const Pose2& pose = map_from_laser;
  const Gate gate{gate_m, std::max(kSlack_m, 0.3 * (gate_m - config.near_gate_m)),
                  std::max(kFirst_sigma * config.sigma_m, 0.3 * gate_m),
                  std::cos(radians(config.max_incidence_deg))};
  const Knowledge knowledge(config);
  const double cos = std::cos(pose.theta_rad);
  const double sin = std::sin(pose.theta_rad);
  const double on_map_m2 = config.on_map_m * config.on_map_m;
  const double plain_m = kPlain_sigma * config.sigma_m;
  Hit hit;
  double fit = 0.0;
  int on_map = 0;
  look(points, pose, scratch.rays);
  WallBeams& beams = scratch.beams;
  beams.clear();
  beams.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const WallsScratch::Ray& ray = scratch.rays[i];
    if (hit.wall == nullptr || !hits_again(hit, ray, plain_m, gate.least_cos)) hit = meet(walls, ray, gate);
    if (hit.nearest_m2 <= on_map_m2) {
      fit += 1.0 - hit.nearest_m2 / on_map_m2;
      ++on_map;
    }
    if (hit.wall == nullptr) continue;
    // The normal looks away from the laser.
    const double sign = hit.across > 0.0 ? 1.0 : -1.0;
    const double nx = -sign * hit.wall->along.y();
    const double ny = sign * hit.wall->along.x();
    beams.add(points[i], ray.unit, {cos * nx + sin * ny, cos * ny - sin * nx},
              nx * (hit.wall->a.x() - pose.x_m) + ny * (hit.wall->a.y() - pose.y_m),
              knowledge.of(ray.range_m, hit.across));
  }
  beams.fill_up();
  const double all = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  return {on_map / all, 1.0 - fit / all};
}

}  // namespace beaconless
