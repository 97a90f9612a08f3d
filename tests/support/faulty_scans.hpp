// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/ray_caster.hpp"

#include "tests/support/faulty_worlds.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless::test {

/// One scan of a world that is not quite what the map says.
struct FaultyScan {
  Pose2 truth;
  std::vector<Eigen::Vector2d> points;  ///< laser frame
};

inline double log_uniform(Rng& rng, double low, double high) {
  return low * std::pow(high / low, rng.uniform());
}

/// What stands elsewhere than the map says.
inline FaultyWorld changed(FaultyWorld world, Fault fault, Rng& rng) {
  const bool is_all = fault == Fault::everything;
  const auto move = [&](FaultyWorld::Box& box) {
    const double way_m = log_uniform(rng, 0.02, 0.5);
    const double to = rng.uniform(-kPi, kPi);
    box.at = {box.at.x_m + way_m * std::cos(to), box.at.y_m + way_m * std::sin(to),
              box.at.theta_rad + rng.normal(0.3 * way_m)};
  };
  const auto shift = [&](double& wall) {
    wall += (rng.uniform() < 0.5 ? -1.0 : 1.0) * rng.uniform(0.01, 0.05);
  };
  if ((is_all || fault == Fault::moved) && !world.boxes.empty())
    move(world.boxes[static_cast<std::size_t>(rng.uniform() * static_cast<double>(world.boxes.size()))]);
  if (fault == Fault::rearranged)
    for (FaultyWorld::Box& box : world.boxes)
      if (rng.uniform() < 1.0 / 3.0) move(box);
  if (is_all || fault == Fault::wall) shift(world.walls[static_cast<std::size_t>(6.0 * rng.uniform())]);
  if (fault == Fault::walls)
    for (double& wall : world.walls)
      if (rng.uniform() < 1.0 / 3.0) shift(wall);
  if (fault == Fault::unmapped) {
    const auto more = static_cast<int>(2.0 + 0.5 * static_cast<double>(world.boxes.size()));
    for (int i = 0; i < more; ++i)
      world.boxes.push_back(
          {{rng.uniform(0.0, world.width_m), rng.uniform(0.0, world.height_m), rng.uniform(-kPi, kPi)},
           {rng.uniform(0.2, 1.2), rng.uniform(0.2, 1.2)}});
  }
  return world;
}

/// A sweep in a changed world, and where what it sees stands.
struct Seen {
  Seen(const FaultyWorld& in, const Pose2& from, Rng& rng) : world(in), truth(from) {
    RayCaster caster(world.plan().segments());
    raw = sweep(caster, truth, 0.0, rng);
  }

  const FaultyWorld& world;
  Pose2 truth;
  RawScan raw;

  double bearing(std::size_t i) const {
    return truth.theta_rad + static_cast<double>(raw.angle_min_rad) +
           static_cast<double>(i) * static_cast<double>(raw.angle_increment_rad);
  }
  /// Which of the walls a beam hits, -1 where none of them.
  int wall_of(std::size_t i) const {
    const double range = raw.ranges_m[i];
    const Eigen::Vector2d end =
        truth.translation() + range * Eigen::Vector2d(std::cos(bearing(i)), std::sin(bearing(i)));
    for (std::size_t wall = 0; wall < 6; ++wall)
      if (std::abs(end[wall % 2 == 0 ? 0 : 1] - world.walls[wall]) < 1e-3) return static_cast<int>(wall);
    return -1;
  }
};

/// People stand before a share of the beams.
inline void cover(RawScan& raw, double share, Rng& rng) {
  const std::size_t size = raw.ranges_m.size();
  std::vector<bool> is_covered(size, false);
  for (double covered = 0.0; covered < share * static_cast<double>(size);) {
    const auto width = static_cast<std::size_t>(rng.uniform(8.0, 60.0));
    const auto first = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(size - width)));
    const double ahead_m = log_uniform(rng, 0.02, 2.5);
    for (std::size_t i = first; i < first + width; ++i) {
      if (is_covered[i]) continue;
      is_covered[i] = true;
      covered += 1.0;
      raw.ranges_m[i] = std::max(0.3F, raw.ranges_m[i] - static_cast<float>(ahead_m + rng.normal(0.01)));
    }
  }
}

/// Something flat stands before one wall.
inline void stand_before_a_wall(Seen& seen, Rng& rng) {
  const int wall = static_cast<int>(6.0 * rng.uniform());
  const double before_m = log_uniform(rng, 0.02, 0.3);
  const double share = rng.uniform(0.3, 1.0);
  std::vector<std::size_t> on_wall;
  for (std::size_t i = 0; i < seen.raw.ranges_m.size(); ++i)
    if (seen.wall_of(i) == wall) on_wall.push_back(i);
  const double from = rng.uniform(0.0, 1.0 - share) * static_cast<double>(on_wall.size());
  for (std::size_t k = static_cast<std::size_t>(from);
       k < static_cast<std::size_t>(from + share * static_cast<double>(on_wall.size())); ++k) {
    const double along = seen.bearing(on_wall[k]);
    const double cos = std::abs(wall % 2 == 0 ? std::cos(along) : std::sin(along));
    float& range_m = seen.raw.ranges_m[on_wall[k]];
    range_m = std::max(0.2F, range_m - static_cast<float>(before_m / std::max(cos, 0.02)));
  }
}

/// Two walls, or one, send nothing back.
inline void make_glass(Seen& seen, bool is_one, Rng& rng) {
  const int first = static_cast<int>(6.0 * rng.uniform());
  const int second = is_one ? first : static_cast<int>(6.0 * rng.uniform());
  for (std::size_t i = 0; i < seen.raw.ranges_m.size(); ++i) {
    const int wall = seen.wall_of(i);
    if (wall == first || wall == second) seen.raw.ranges_m[i] = std::numeric_limits<float>::infinity();
  }
}

/// Sees a world whose plan is the map from a free place in it.
inline FaultyScan see_faulty(const FaultyWorld& map, Fault fault, Rng& rng) {
  const bool is_all = fault == Fault::everything;
  // 1. What is elsewhere.
  const FaultyWorld world = changed(map, fault, rng);
  // 2. Where the laser is.
  FaultyScan scan;
  do {
    scan.truth = {rng.uniform(0.0, map.width_m), rng.uniform(0.0, map.height_m), rng.uniform(-kPi, kPi)};
  } while (!map.is_free(scan.truth.translation(), 0.4) || !world.is_free(scan.truth.translation(), 0.4));
  const double sigma_m = is_all || fault == Fault::noise ? rng.uniform(0.005, 0.02) : 0.01;
  Seen seen(world, scan.truth, rng);
  // 3. What stands in the way, and what sends nothing back.
  if (is_all || fault == Fault::people)
    cover(seen.raw, is_all ? rng.uniform(0.05, 0.3) : rng.uniform(0.2, 0.6), rng);
  if (fault == Fault::row) stand_before_a_wall(seen, rng);
  if (is_all || fault == Fault::glass) make_glass(seen, is_all, rng);
  // 4. Noise.
  for (float& range : seen.raw.ranges_m)
    range = static_cast<float>(static_cast<double>(range) + rng.normal(sigma_m));
  scan.points = points_of(Scan::make(seen.raw).value());
  return scan;
}

}  // namespace beaconless::test
