// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/ray_caster.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless {
namespace {

Eigen::Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

/// The slow twin: every wall is asked, by Cramer's rule.
std::optional<RayHit> cast_slowly(const std::vector<Segment2>& walls, const Eigen::Vector2d& origin,
                                  const Eigen::Vector2d& direction, double max_range_m) {
  std::optional<RayHit> nearest;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Eigen::Vector2d e = walls[i].b - walls[i].a;
    const Eigen::Vector2d to_a = walls[i].a - origin;
    const double d = direction.x() * e.y() - direction.y() * e.x();
    const double range = (to_a.x() * e.y() - to_a.y() * e.x()) / d;
    const double along = (to_a.x() * direction.y() - to_a.y() * direction.x()) / d;
    if (!(along >= 0.0 && along <= 1.0 && range >= 0.0 && range <= max_range_m)) continue;
    if (!nearest || range < nearest->range_m) nearest = RayHit{range, i, std::abs(d) / e.norm()};
  }
  return nearest;
}

std::vector<Segment2> random_walls(std::size_t count, double longest_m, Rng& rng) {
  std::vector<Segment2> walls;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d a(rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0));
    walls.push_back({a, a + rng.uniform(0.0, longest_m) * unit(rng.uniform(0.0, 2.0 * kPi))});
  }
  return walls;
}

TEST(RayCaster, AgreesWithItsSlowTwin) {
  Rng rng(1);
  int rays = 0;
  for (const auto& [count, longest_m] : {std::pair{1, 5.0}, {7, 40.0}, {60, 10.0}, {300, 2.0}, {1000, 0.5}}) {
    const auto walls = random_walls(static_cast<std::size_t>(count), longest_m, rng);
    const RayCaster caster(walls);
    for (int i = 0; i < 20'000; ++i, ++rays) {
      const Eigen::Vector2d origin(rng.uniform(-30.0, 30.0), rng.uniform(-30.0, 30.0));
      // One ray in four runs along an axis, where borders of buckets are met head-on or never.
      const double angle =
          i % 4 == 0 ? 0.5 * kPi * std::floor(rng.uniform(0.0, 4.0)) : rng.uniform(-4.0, 4.0);
      const Eigen::Vector2d direction =
          i % 4 == 0 ? Eigen::Vector2d(unit(angle).array().round()) : unit(angle);
      const double max_range_m = rng.uniform(0.0, 60.0);
      const auto fast = caster.cast(origin, direction, max_range_m);
      const auto slow = cast_slowly(walls, origin, direction, max_range_m);
      ASSERT_EQ(fast.has_value(), slow.has_value()) << "ray " << rays;
      if (!fast) continue;
      ASSERT_EQ(fast->segment, slow->segment) << "ray " << rays;
      ASSERT_NEAR(fast->range_m, slow->range_m, 1e-9 / slow->cos_incidence);
      ASSERT_NEAR(fast->cos_incidence, slow->cos_incidence, 1e-9 / slow->cos_incidence);
    }
  }
  EXPECT_EQ(rays, 100'000);
}

TEST(RayCaster, ClosedOutlinesDoNotLeak) {
  Rng rng(2);
  for (int outline = 0; outline < 50; ++outline) {
    const int corners = 3 + outline;
    const Eigen::Vector2d center(rng.uniform(-500.0, 500.0), rng.uniform(-500.0, 500.0));
    FloorPlan::Polyline wall;
    for (int i = 0; i < corners; ++i)
      wall.push_back(center +
                     rng.uniform(2.0, 9.0) * unit(2.0 * kPi * (i + rng.uniform(0.0, 0.8)) / corners));
    wall.push_back(wall.front());
    const RayCaster caster(FloorPlan{{wall}}.segments());
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector2d origin = center + 0.01 * unit(rng.uniform(0.0, 6.3));
      ASSERT_TRUE(caster.cast(origin, unit(rng.uniform(0.0, 6.3)), 1e3));
    }
    // Straight at the corners, and a few roundings beside them.
    for (const Eigen::Vector2d& corner : wall) {
      Eigen::Vector2d direction = (corner - center).normalized();
      for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(caster.cast(center, direction, 1e3)) << "corner of outline " << outline;
        direction.x() = std::nextafter(direction.x(), 2.0);
      }
    }
  }
}

TEST(RayCaster, CornersOnTheBordersOfBucketsDoNotLeak) {
  // Every corner of this raster lies where rays pass from bucket to bucket through a common point.
  std::vector<Segment2> walls;
  for (int i = 0; i < 16; ++i) {
    walls.push_back({{i - 8.0, -8.0}, {i - 7.0, -8.0}});
    walls.push_back({{i - 8.0, 8.0}, {i - 7.0, 8.0}});
    walls.push_back({{-8.0, i - 8.0}, {-8.0, i - 7.0}});
    walls.push_back({{8.0, i - 8.0}, {8.0, i - 7.0}});
  }
  const RayCaster caster(walls);
  for (int x = -7; x < 8; ++x)
    for (int y = -7; y < 8; ++y)
      for (int beam = 0; beam < 720; ++beam)
        ASSERT_TRUE(caster.cast({double(x), double(y)}, unit(kPi * beam / 360.0), 100.0))
            << x << " " << y << " " << beam;
}

TEST(RayCaster, TellsRangeWallAndIncidence) {
  const RayCaster caster({{{2.0, -1.0}, {2.0, 1.0}}, {{4.0, -9.0}, {4.0, 9.0}}});
  const auto straight = caster.cast({0.0, 0.0}, {1.0, 0.0}, 30.0);
  ASSERT_TRUE(straight);
  EXPECT_DOUBLE_EQ(straight->range_m, 2.0);
  EXPECT_EQ(straight->segment, 0U);
  EXPECT_DOUBLE_EQ(straight->cos_incidence, 1.0);
  const auto oblique = caster.cast({0.0, 0.0}, unit(radians(60.0)), 30.0);
  ASSERT_TRUE(oblique);
  EXPECT_NEAR(oblique->range_m, 8.0, 1e-12);
  EXPECT_EQ(oblique->segment, 1U);
  EXPECT_NEAR(oblique->cos_incidence, 0.5, 1e-12);
  EXPECT_FALSE(caster.cast({0.0, 0.0}, {1.0, 0.0}, 1.999));
  EXPECT_FALSE(caster.cast({0.0, 0.0}, {-1.0, 0.0}, 30.0));
  EXPECT_FALSE(caster.cast({2.0, -5.0}, {0.0, 1.0}, 3.0));
}

TEST(RayCaster, TakesAnyWallsAndAnyRay) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(RayCaster({}).cast({0.0, 0.0}, {1.0, 0.0}, 30.0));
  const RayCaster caster({{{nan, 0.0}, {1.0, 1.0}},
                          {{1e300, -1e300}, {1e300, 1e300}},
                          {{1.0, 0.0}, {1.0, 0.0}},
                          {{inf, -1.0}, {3.0, 1.0}},
                          {{3.0, -1.0}, {3.0, 1.0}}});
  const auto hit = caster.cast({0.0, 0.0}, {1.0, 0.0}, inf);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->segment, 4U);
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_FALSE(caster.cast({bad, 0.0}, {1.0, 0.0}, 30.0));
    EXPECT_FALSE(caster.cast({0.0, 0.0}, {bad, 0.0}, 30.0));
  }
  EXPECT_FALSE(caster.cast({0.0, 0.0}, {1.0, 0.0}, nan));
  EXPECT_FALSE(caster.cast({0.0, 0.0}, {0.0, 0.0}, 30.0));
  // A single straight wall has buckets of no area.
  EXPECT_TRUE(RayCaster({{{0.0, 5.0}, {1e7, 5.0}}}).cast({1e6, 0.0}, {0.0, 1.0}, 30.0));
}

}  // namespace
}  // namespace beaconless
