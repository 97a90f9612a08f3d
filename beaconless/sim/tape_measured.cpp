// SPDX-License-Identifier: Apache-2.0
#include "beaconless/sim/tape_measured.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

namespace beaconless::sim {
namespace {

constexpr double kTouch_m = 0.002;  // an end this near to a wall was meant to touch it

/// A wall as it is, and the line that was measured for it.
struct Wall {
  Segment2 real;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // measured
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  // measured, unit

  /// Where a point of the real wall lies on the measured one.
  Eigen::Vector2d image(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d real_along = (real.b - real.a).normalized();
    return middle + real_along.dot(point - 0.5 * (real.a + real.b)) * along;
  }
};

/// A polyline on its way: its corners as they are, its walls, and where it ends up.
struct Outline {
  FloorPlan::Polyline corners;  // the first is not repeated
  bool is_closed = false;
  std::vector<Wall> walls;  // wall k leads from corner k to the next
  double free_first_m = 0.0;
  double free_last_m = 0.0;
  FloorPlan::Polyline measured;

  bool is_end(std::size_t k) const { return !is_closed && (k == 0 || k + 1 == corners.size()); }
};

double cross(const Eigen::Vector2d& p, const Eigen::Vector2d& q) { return p.x() * q.y() - p.y() * q.x(); }

bool is_measurable(const FloorPlan::Polyline& polyline) {
  return std::ranges::all_of(polyline, [](const Eigen::Vector2d& p) { return p.allFinite(); }) &&
         std::ranges::any_of(polyline, [&](const Eigen::Vector2d& p) { return p != polyline.front(); });
}

Outline outline_of(const FloorPlan::Polyline& polyline) {
  Outline outline;
  outline.corners.reserve(polyline.size());
  for (const Eigen::Vector2d& corner : polyline)
    if (outline.corners.empty() || corner != outline.corners.back()) outline.corners.push_back(corner);
  outline.is_closed = outline.corners.size() > 2 && outline.corners.front() == outline.corners.back();
  if (outline.is_closed) outline.corners.pop_back();
  const std::size_t n = outline.corners.size();
  const std::size_t walls = outline.is_closed ? n : n - 1;
  outline.walls.reserve(walls);
  for (std::size_t k = 0; k < walls; ++k) {
    const Segment2 real{outline.corners[k], outline.corners[(k + 1) % n]};
    outline.walls.push_back({real, 0.5 * (real.a + real.b), (real.b - real.a).normalized()});
  }
  return outline;
}

bool is_body(const Outline& outline, double body_m) {
  if (!outline.is_closed) return false;
  const FloorPlan::Bounds bounds = FloorPlan{{outline.corners}}.bounds();
  return (bounds.high - bounds.low).maxCoeff() <= body_m;
}

/// Moves all of a small thing alike.
void measure_body(Outline& outline, const TapeConfig& config, Rng& rng) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : outline.corners) centre += corner;
  centre /= static_cast<double>(outline.corners.size());
  const double x_m = rng.normal(config.offset_sigma_m);
  const double y_m = rng.normal(config.offset_sigma_m);
  const Pose2 moved{centre.x() + x_m, centre.y() + y_m, rng.normal(radians(config.turn_sigma_deg))};
  for (Wall& wall : outline.walls) {
    wall.middle = moved * Eigen::Vector2d(wall.middle - centre);
    wall.along = moved.rotation() * wall.along;
  }
}

/// Moves each wall for itself.
void measure_walls(Outline& outline, const TapeConfig& config, Rng& rng) {
  for (Wall& wall : outline.walls) {
    const double offset_m = rng.normal(config.offset_sigma_m);
    const Pose2 turn{0.0, 0.0, rng.normal(radians(config.turn_sigma_deg))};
    wall.middle += offset_m * Eigen::Vector2d(-wall.along.y(), wall.along.x());
    wall.along = turn * wall.along;
  }
  outline.free_first_m = rng.normal(config.offset_sigma_m);
  outline.free_last_m = rng.normal(config.offset_sigma_m);
}

/// Where two measured walls meet that met at `real`.
Eigen::Vector2d corner_of(const Wall& p, const Wall& q, const Eigen::Vector2d& real, double flat_sine) {
  const double sine = cross(p.along, q.along);
  if (std::abs(sine) < flat_sine) return 0.5 * (p.image(real) + q.image(real));
  return p.middle + cross(q.middle - p.middle, q.along) / sine * p.along;
}

/// All corners between two walls; ends of open polylines wait for what they may touch.
void place_corners(Outline& outline, double flat_sine) {
  const std::size_t n = outline.corners.size();
  outline.measured.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    if (outline.is_end(k)) continue;
    const Wall& before = outline.walls[(k + outline.walls.size() - 1) % outline.walls.size()];
    outline.measured[k] = corner_of(before, outline.walls[k], outline.corners[k], flat_sine);
  }
}

/// The measured corner of another outline in which an end lies.
std::optional<Eigen::Vector2d> touched_corner(const std::vector<Outline>& outlines,
                                              const Eigen::Vector2d& end) {
  for (const Outline& outline : outlines)
    for (std::size_t k = 0; k < outline.corners.size(); ++k)
      if (!outline.is_end(k) && (outline.corners[k] - end).norm() <= kTouch_m) return outline.measured[k];
  return std::nullopt;
}

/// The wall as it is drawn: from one corner to the other, wherever its own line lay.
Wall drawn_wall(const Outline& outline, std::size_t k) {
  Wall wall = outline.walls[k];
  const std::size_t next = (k + 1) % outline.corners.size();
  if (outline.is_end(k) || outline.is_end(next)) return wall;
  const Eigen::Vector2d way = outline.measured[next] - outline.measured[k];
  if (way.squaredNorm() <= 0.0) return wall;
  wall.middle = 0.5 * (outline.measured[k] + outline.measured[next]);
  wall.along = way.normalized();
  return wall;
}

/// The wall nearest to an end that touches one, but for the end's own.
std::optional<Wall> touched_wall(const std::vector<Outline>& outlines, const Eigen::Vector2d& end,
                                 const Wall& own) {
  std::optional<Wall> nearest;
  double nearest_m = kTouch_m;
  for (const Outline& outline : outlines)
    for (std::size_t k = 0; k < outline.walls.size(); ++k) {
      const double distance_m = outline.walls[k].real.distance_m(end);
      if (&outline.walls[k] == &own || distance_m > nearest_m) continue;
      if (nearest && distance_m == nearest_m) continue;
      nearest_m = distance_m;
      nearest = drawn_wall(outline, k);
    }
  return nearest;
}

/// Where an end of an open polyline comes to lie.
Eigen::Vector2d end_of(const std::vector<Outline>& outlines, const Wall& wall, const Eigen::Vector2d& real,
                       double free_m, double flat_sine) {
  if (const auto corner = touched_corner(outlines, real)) return *corner;
  const Eigen::Vector2d image = wall.image(real);
  const auto touched = touched_wall(outlines, real, wall);
  if (!touched) return image + free_m * wall.along;
  if (std::abs(cross(wall.along, touched->along)) < flat_sine)
    return touched->middle + touched->along.dot(image - touched->middle) * touched->along;
  return corner_of(wall, *touched, real, flat_sine);
}

}  // namespace

void describe(Fields& fields, TapeConfig& config) {
  fields("offset_sigma_m", config.offset_sigma_m, {0.0, 1.0}, "by how much a wall is off, along its normal");
  fields("turn_sigma_deg", config.turn_sigma_deg, {0.0, 10.0}, "by how much a wall is turned");
  fields("body_m", config.body_m, {0.0, 1000.0}, "closed outlines up to this size are measured as one thing");
  fields("flat_deg", config.flat_deg, {0.1, 60.0}, "neighbours that turn by less share their corner");
  fields("seed", config.seed, {0, 2147483647}, "other seeds give other errors");
}

FloorPlan tape_measured(const FloorPlan& plan, const TapeConfig& config) {
  const double flat_sine = std::sin(radians(config.flat_deg));
  Rng rng(static_cast<std::uint64_t>(config.seed));
  // 1. Measure every wall.
  std::vector<Outline> outlines(plan.walls.size());
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    Rng own = rng.fork(i);
    if (!is_measurable(plan.walls[i])) continue;
    outlines[i] = outline_of(plan.walls[i]);
    if (is_body(outlines[i], config.body_m))
      measure_body(outlines[i], config, own);
    else
      measure_walls(outlines[i], config, own);
  }
  // 2. Draw the corners, then the ends onto what they touch.
  for (Outline& outline : outlines) place_corners(outline, flat_sine);
  for (Outline& outline : outlines) {
    if (outline.is_closed || outline.corners.empty()) continue;
    outline.measured.front() =
        end_of(outlines, outline.walls.front(), outline.corners.front(), outline.free_first_m, flat_sine);
    outline.measured.back() =
        end_of(outlines, outline.walls.back(), outline.corners.back(), outline.free_last_m, flat_sine);
  }
  // 3. Hand over.
  FloorPlan measured;
  measured.walls.reserve(plan.walls.size());
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    FloorPlan::Polyline& wall = measured.walls.emplace_back(std::move(outlines[i].measured));
    if (wall.empty()) wall = plan.walls[i];
    if (outlines[i].is_closed) wall.push_back(wall.front());
  }
  return measured;
}

}  // namespace beaconless::sim
