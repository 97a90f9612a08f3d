// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/map_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

constexpr int kGlances = 72;          // rays that judge a place
constexpr double kGlance_m = 1000.0;  // walls further than this are not around
// Share of the glances that must meet a wall, if any place has it; outside of a house, between two of its
// wings, it is 3/4 at most.
constexpr std::array kAround = {0.76, 0.3};
constexpr double kJitter_steps = 0.3;
constexpr std::size_t kFewest = 60;   // places; of a map that has fewer, more are taken nearer together …
constexpr double kLeastStep_m = 0.1;  // … but no nearer than this
constexpr float kNearest_m = 0.01F;

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
};

Bounds bounds_of(const RayCaster& walls) {
  Bounds bounds;
  for (const Segment2& wall : walls.segments()) {
    if (!(wall.a.cwiseAbs().maxCoeff() <= RayCaster::kFarthest_m) ||
        !(wall.b.cwiseAbs().maxCoeff() <= RayCaster::kFarthest_m))
      continue;
    bounds.low = bounds.low.cwiseMin(wall.a).cwiseMin(wall.b);
    bounds.high = bounds.high.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  return bounds;
}

/// The share of glances all around that meet a wall; 0 where one is nearer than the clearance.
double share_around(const RayCaster& walls, const Eigen::Vector2d& place, double clearance_m) {
  int met = 0;
  for (int i = 0; i < kGlances; ++i) {
    const double bearing = 2.0 * kPi * i / kGlances;
    const auto hit = walls.cast(place, {std::cos(bearing), std::sin(bearing)}, kGlance_m);
    if (!hit) continue;
    if (hit->range_m < clearance_m) return 0.0;
    ++met;
  }
  return static_cast<double>(met) / kGlances;
}

struct Place {
  Pose2 pose;
  double around;
};

/// The places of one lattice that have room.
std::vector<Place> lattice(const RayCaster& walls, const OccupancyGrid* grid, const Bounds& bounds,
                           double step_m, double clearance_m) {
  std::vector<Place> places;
  Rng rng(1);
  const auto columns = static_cast<int>((bounds.high.x() - bounds.low.x()) / step_m) + 1;
  const auto rows = static_cast<int>((bounds.high.y() - bounds.low.y()) / step_m) + 1;
  const Eigen::Vector2d middle = 0.5 * (bounds.low + bounds.high);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double dx = column - 0.5 * (columns - 1) + rng.uniform(-kJitter_steps, kJitter_steps);
      const double dy = row - 0.5 * (rows - 1) + rng.uniform(-kJitter_steps, kJitter_steps);
      const double heading = rng.uniform(-kPi, kPi);
      const Eigen::Vector2d place = middle + step_m * Eigen::Vector2d(dx, dy);
      if (grid != nullptr && !grid->is_free(grid->cell_at(place))) continue;
      if (const double around = share_around(walls, place, clearance_m); around > 0.0)
        places.push_back({{place.x(), place.y(), heading}, around});
    }
  return places;
}

std::vector<Pose2> enclosed(const std::vector<Place>& places) {
  std::vector<Pose2> poses;
  poses.reserve(places.size());
  for (const double around : kAround) {
    for (const Place& place : places)
      if (place.around >= around) poses.push_back(place.pose);
    if (!poses.empty()) return poses;
  }
  for (const Place& place : places) poses.push_back(place.pose);
  return poses;
}

}  // namespace

void describe(Fields& fields, MapViewsConfig& config) {
  fields("step_m", config.step_m, {0.05, 10.0}, "distance between the places that the map is looked at from");
  fields("clearance_m", config.clearance_m, {0.0, 5.0}, "no wall is nearer to them");
  fields("range_m", config.range_m, {1.0, 1000.0}, "how far is looked");
  fields("beam_deg", config.beam_deg, {0.05, 5.0}, "between two beams; that of the scanner");
  fields("most", config.most, {10, 100000}, "of larger maps the step is made larger");
}

std::vector<Pose2> choose_map_views(const RayCaster& walls, const OccupancyGrid* grid,
                                    const MapViewsConfig& config) {
  const Bounds bounds = bounds_of(walls);
  if (!(bounds.low.x() <= bounds.high.x())) return {};
  // 1. A lattice of not too many places.
  const Eigen::Vector2d extent = bounds.high - bounds.low;
  double step_m = std::max(
      {config.step_m, std::sqrt(extent.x() * extent.y() / config.most), extent.maxCoeff() / config.most});
  std::vector<Pose2> poses = enclosed(lattice(walls, grid, bounds, step_m, config.clearance_m));
  // 2. A narrower one where there are few: small rooms, or walls around little of the bounds.
  while (poses.size() < kFewest && 0.5 * step_m >= kLeastStep_m &&
         extent.x() * extent.y() <= config.most * step_m * step_m) {
    step_m *= 0.5;
    poses = enclosed(lattice(walls, grid, bounds, step_m, config.clearance_m));
  }
  return poses;
}

Scan look_at_map(const RayCaster& walls, const Pose2& map_from_laser, const MapViewsConfig& config) {
  const int beams = std::max(4, static_cast<int>(std::lround(360.0 / config.beam_deg)));
  RawScan raw{.angle_min_rad = static_cast<float>(-kPi),
              .angle_increment_rad = static_cast<float>(2.0 * kPi / beams),
              .range_min_m = kNearest_m,
              .range_max_m = static_cast<float>(config.range_m)};
  raw.ranges_m.reserve(static_cast<std::size_t>(beams));
  for (int i = 0; i < beams; ++i) {
    const double bearing = map_from_laser.theta_rad + static_cast<double>(raw.angle_min_rad) +
                           i * static_cast<double>(raw.angle_increment_rad);
    const auto hit =
        walls.cast(map_from_laser.translation(), {std::cos(bearing), std::sin(bearing)}, config.range_m);
    raw.ranges_m.push_back(hit ? static_cast<float>(hit->range_m) : std::numeric_limits<float>::infinity());
  }
  return Scan::make(std::move(raw)).value();
}

}  // namespace beaconless
