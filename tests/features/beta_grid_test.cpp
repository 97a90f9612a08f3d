// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/beta_grid.hpp"

#include <numeric>
#include <optional>

#include <gtest/gtest.h>

#include "descriptor_scenes.hpp"
#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

struct Interval {
  double from, to;
  double length() const { return std::max(0.0, to - from); }
};

/// The part of a line o + t d within a circle around the origin.
Interval in_disc(const Eigen::Vector2d& o, const Eigen::Vector2d& d, double radius_m) {
  const double middle = -o.dot(d);
  const double square = radius_m * radius_m - (o + middle * d).squaredNorm();
  if (square <= 0.0) return {0.0, 0.0};
  return {middle - std::sqrt(square), middle + std::sqrt(square)};
}

/// The part of it on the left of a ray from the origin.
Interval on_left_of(const Eigen::Vector2d& o, const Eigen::Vector2d& d, double angle_rad) {
  const Eigen::Vector2d normal(-std::sin(angle_rad), std::cos(angle_rad));
  const double slope = normal.dot(d);
  const double at = -normal.dot(o) / slope;
  return slope > 0.0 ? Interval{at, 1e9} : Interval{-1e9, at};
}

Interval both(const Interval& a, const Interval& b) {
  return {std::max(a.from, b.from), std::min(a.to, b.to)};
}

/// Every cell against every beam: how long the beam's free part runs within the cell. Nothing where that is
/// so little, or an end point so near to a border, that rounding decides.
std::optional<BetaGridCounts> slow_twin(const Scan& scan, const Keypoint& keypoint,
                                        const BetaGridConfig& config) {
  const double outer = config.neighbourhood.radius_at(keypoint.point.norm());
  const auto radius = [&](int ring) { return config.inner_m + (outer - config.inner_m) * ring / 4.0; };
  const Pose2 sensor_from_keypoint{keypoint.point.x(), keypoint.point.y(), keypoint.orientation_rad};
  const Pose2 keypoint_from_sensor = sensor_from_keypoint.inverse();
  const Eigen::Vector2d o = keypoint_from_sensor.translation();
  BetaGridCounts counts;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const bool hit = scan.is_hit(beam);
    if (!hit && scan.beams()[beam] != Beam::no_return) continue;
    const Eigen::Vector2d end = keypoint_from_sensor * scan.point(beam);
    const Eigen::Vector2d d = hit ? Eigen::Vector2d((end - o).normalized())
                                  : Eigen::Vector2d(keypoint_from_sensor.rotation() * scan.direction(beam));
    const Interval free{0.0, hit ? (end - o).norm() - config.margin_m : 1e9};
    for (int ring = 0; ring < 4; ++ring)
      for (int sector = 0; sector < 12; ++sector) {
        const auto cell = static_cast<std::size_t>(ring * 12 + sector);
        const double begin_rad = sector * kPi / 6.0;
        if (hit) {
          const double bearing = std::atan2(end.y(), end.x());
          const double turn = (bearing < 0.0 ? bearing + 2.0 * kPi : bearing) / (kPi / 6.0);
          if (std::abs(end.norm() - radius(ring)) < 1e-5 || std::abs(end.norm() - radius(ring + 1)) < 1e-5)
            return std::nullopt;
          if (end.norm() < outer && std::abs(turn - std::round(turn)) < 1e-5) return std::nullopt;
          if (end.norm() >= radius(ring) && end.norm() < radius(ring + 1) &&
              static_cast<int>(turn) == sector) {
            ++counts.hits[cell];
            continue;
          }
        }
        const Interval wedge = both(on_left_of(o, d, begin_rad), on_left_of(-o, -d, begin_rad + kPi / 6.0));
        const Interval inside = both(both(wedge, free), in_disc(o, d, radius(ring + 1)));
        const double length = inside.length() - both(inside, in_disc(o, d, radius(ring))).length();
        if (length > 0.0 && length < 1e-5) return std::nullopt;
        if (length > 0.0) ++counts.misses[cell];
      }
  }
  return counts;
}

double sum_of(const BetaGrid& grid) { return std::accumulate(grid.cells.begin(), grid.cells.end(), 0.0); }

TEST(BetaGrid, CountsWhatEveryCellAgainstEveryBeamSays) {
  Rng rng(1);
  const RayCaster walls(test::niche_room().segments());
  int compared = 0;
  for (int run = 0; run < 60; ++run) {
    const Pose2 pose{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.0), rng.uniform(-3.0, 3.0)};
    RawScan raw = run % 2 == 0 ? test::sweep(walls, pose, 0.01, rng) : test::circle_sweep(walls, pose, 360);
    for (float& range : raw.ranges_m) {
      if (rng.uniform() < 0.05) range = std::numeric_limits<float>::quiet_NaN();
      if (rng.uniform() < 0.05) range = std::numeric_limits<float>::infinity();
    }
    const Scan scan = Scan::make(raw).value();
    const BetaGridConfig config{.neighbourhood = {.radius_m = rng.uniform(0.2, 1.5)},
                                .inner_m = rng.uniform(0.0, 0.1),
                                .margin_m = rng.uniform(0.0, 0.05)};
    auto keypoints = test::seen_from(test::niche_room_corners(), pose);
    keypoints.push_back({.point = {rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)}});  // at the sensor itself
    for (Keypoint keypoint : keypoints) {
      keypoint.orientation_rad = rng.uniform(-3.0, 3.0);
      const auto slow = slow_twin(scan, keypoint, config);
      if (!slow) continue;
      ++compared;
      ASSERT_EQ(count_beta_grid(scan, keypoint, config), *slow) << "run " << run;
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(BetaGrid, AWallIsHitsWithFreeSpaceBeforeAndNothingKnownBehind) {
  const RayCaster walls(test::rectangle(4.0, 4.0).segments());
  const Scan scan = Scan::make(test::circle_sweep(walls, {2, 2, 0}, 1440)).value();
  const Keypoint on_the_wall{.point = {2.0, 0.05}, .orientation_rad = kPi};  // x of its frame: into the room
  const BetaGridCounts counts = count_beta_grid(scan, on_the_wall);
  for (const int ring : {1, 2, 3}) {
    for (const int sector : {0, 1, 10, 11}) {
      EXPECT_EQ(counts.hits[static_cast<std::size_t>(ring * 12 + sector)], 0);
      EXPECT_GT(counts.misses[static_cast<std::size_t>(ring * 12 + sector)], 0);
    }
    for (const int sector : {4, 5, 6, 7}) {
      EXPECT_EQ(counts.hits[static_cast<std::size_t>(ring * 12 + sector)], 0);
      EXPECT_EQ(counts.misses[static_cast<std::size_t>(ring * 12 + sector)], 0);
    }
    EXPECT_GT(counts.hits[static_cast<std::size_t>(ring * 12 + 2)] +
                  counts.hits[static_cast<std::size_t>(ring * 12 + 3)],
              0);
  }
  EXPECT_NEAR(sum_of(describe_beta_grid(scan, {&on_the_wall, 1}).front()), 1.0, 1e-5);
}

TEST(BetaGrid, ATurnedSensorDescribesTheSame) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3.1, 1.7, 0.0};
  const RawScan raw = test::circle_sweep(walls, pose, 1440);
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  const auto still = describe_beta_grid(Scan::make(raw).value(), corners);
  for (std::size_t beams = 0; beams < 1440; beams += 37) {
    const auto turned = test::seen_from(corners, {0, 0, -2.0 * kPi * static_cast<double>(beams) / 1440});
    const auto after = describe_beta_grid(Scan::make(test::turned_by_beams(raw, beams)).value(), turned);
    for (std::size_t k = 0; k < corners.size(); ++k) ASSERT_LT(distance(still[k], after[k]), 0.02) << k;
  }
}

TEST(BetaGrid, DistanceTellsCornersApart) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3.1, 1.7, 0.4};
  const Scan scan = Scan::make(test::circle_sweep(walls, pose, 1440)).value();
  const auto all = describe_beta_grid(scan, test::seen_from(test::niche_room_corners(), pose));
  EXPECT_EQ(distance(all[0], all[0]), 0.0);
  EXPECT_EQ(distance(all[0], all[2]), distance(all[2], all[0]));
  EXPECT_LT(distance(all[0], all[1]), kBetaGridSame);             // concave and concave
  EXPECT_GT(distance(all[0], all[2]), distance(all[0], all[1]));  // concave and convex
}

TEST(BetaGrid, OfFreeSpaceAndOfNothingIsUniform) {
  RawScan raw{.angle_min_rad = 0.0F, .angle_increment_rad = 0.01F, .range_max_m = 30.0F};
  raw.ranges_m.assign(100, 20.0F);
  const Scan free = Scan::make(raw).value();
  raw.ranges_m.assign(100, std::numeric_limits<float>::quiet_NaN());
  const Scan nothing = Scan::make(raw).value();
  const Keypoint keypoint{.point = {2.0, 1.0}};
  for (const Scan& scan : {free, nothing}) {
    const BetaGrid grid = describe_beta_grid(scan, {&keypoint, 1}).front();
    for (const float cell : grid.cells) EXPECT_NEAR(cell, 1.0F / 48.0F, 1e-6F);
  }
}

TEST(BetaGrid, AllocatesNothingOnceGrown) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3, 2, 0.3};
  const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  std::vector<BetaGrid> out;
  describe_beta_grid(scan, corners, {}, out);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  describe_beta_grid(scan, corners, {}, out);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
