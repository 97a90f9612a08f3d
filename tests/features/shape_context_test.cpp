// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/shape_context.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "descriptor_scenes.hpp"
#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

double sum_of(const ShapeContext& descriptor) {
  return std::accumulate(descriptor.cells.begin(), descriptor.cells.end(), 0.0);
}

TEST(ShapeContext, IsWhatArcTangentsAndSquareRootsSay) {
  Rng rng(1);
  const RayCaster walls(test::niche_room().segments());
  int compared = 0;
  for (int run = 0; run < 100; ++run) {
    const Pose2 pose{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.0), rng.uniform(-3.0, 3.0)};
    const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
    for (Keypoint keypoint : test::seen_from(test::niche_room_corners(), pose)) {
      keypoint.orientation_rad = rng.uniform(-3.0, 3.0);
      std::array<double, 48> slow{};
      double all = 0.0;
      bool on_border = false;
      for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector2d to = scan.point(i) - keypoint.point;
        if (!scan.is_hit(i)) continue;
        const double ring = (to.norm() - 0.02) / 0.48 * 4.0;
        const double turn = wrap_angle(std::atan2(to.y(), to.x()) - keypoint.orientation_rad);
        const double sector = (turn < 0.0 ? turn + 2.0 * kPi : turn) / (2.0 * kPi) * 12.0;
        if (ring < -0.01 || ring > 4.01) continue;
        on_border |= std::abs(ring - std::round(ring)) < 1e-4 || std::abs(sector - std::round(sector)) < 1e-4;
        if (ring < 0.0 || ring >= 4.0) continue;
        slow[static_cast<std::size_t>(ring) * 12 + static_cast<std::size_t>(sector) % 12] += 1.0;
        all += 1.0;
      }
      const ShapeContext fast = describe_shape_context(scan, {&keypoint, 1}).front();
      ASSERT_NEAR(sum_of(fast), 1.0, 1e-6);
      if (on_border || all == 0.0) continue;
      ++compared;
      for (std::size_t cell = 0; cell < 48; ++cell)
        ASSERT_NEAR(static_cast<double>(fast.cells[cell]), slow[cell] / all, 1e-6);
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(ShapeContext, ATurnedSensorDescribesTheSame) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3.1, 1.7, 0.0};
  const RawScan raw = test::circle_sweep(walls, pose, 1440);
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  const auto still = describe_shape_context(Scan::make(raw).value(), corners);
  for (std::size_t beams = 0; beams < 1440; beams += 37) {
    const auto turned = test::seen_from(corners, {0, 0, -2.0 * kPi * static_cast<double>(beams) / 1440});
    const auto after = describe_shape_context(Scan::make(test::turned_by_beams(raw, beams)).value(), turned);
    for (std::size_t k = 0; k < corners.size(); ++k) ASSERT_LT(distance(still[k], after[k]), 0.02) << k;
  }
}

TEST(ShapeContext, DistanceTellsCornersApart) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3.1, 1.7, 0.4};
  const Scan scan = Scan::make(test::circle_sweep(walls, pose, 1440)).value();
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  const auto all = describe_shape_context(scan, corners);
  EXPECT_EQ(distance(all[0], all[0]), 0.0);
  EXPECT_EQ(distance(all[0], all[2]), distance(all[2], all[0]));
  EXPECT_LT(distance(all[0], all[1]), kShapeContextSame);  // concave and concave
  EXPECT_GT(distance(all[0], all[2]), kShapeContextSame);  // concave and convex
}

TEST(ShapeContext, OfNothingIsUniform) {
  const Scan scan = Scan::make({.angle_min_rad = 0.0F,
                                .angle_increment_rad = 0.1F,
                                .range_max_m = 30.0F,
                                .ranges_m = {5.0F, 5.0F}})
                        .value();
  const Keypoint keypoint{.point = {2.0, 0.0}};
  const auto uniform = describe_shape_context(scan, {&keypoint, 1}).front();
  EXPECT_EQ(uniform.cells.front(), 1.0F / 48.0F);
  EXPECT_NEAR(sum_of(uniform), 1.0, 1e-6);
}

TEST(ShapeContext, AllocatesNothingOnceGrown) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3, 2, 0.3};
  const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  std::vector<ShapeContext> out;
  describe_shape_context(scan, corners, {}, out);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  describe_shape_context(scan, corners, {}, out);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
