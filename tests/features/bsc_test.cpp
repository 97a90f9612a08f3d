// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/bsc.hpp"

#include <gtest/gtest.h>

#include "descriptor_scenes.hpp"
#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

BscDescriptor random_descriptor(Rng& rng) { return {{rng.bits(), rng.bits()}}; }

/// Sectors and rings by arc tangent and square root, all beams, cell by cell.
BscDescriptor slow_twin(const Scan& scan, const Keypoint& keypoint, const BscConfig& config,
                        bool& on_border) {
  BscDescriptor descriptor;
  const double outer = config.neighbourhood.radius_at(keypoint.point.norm());
  on_border = false;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.is_hit(i)) continue;
    const Eigen::Vector2d to = scan.point(i) - keypoint.point;
    const double ring = (to.norm() - config.inner_m) / (outer - config.inner_m) * BscDescriptor::kRings;
    const double turn = wrap_angle(std::atan2(to.y(), to.x()) - keypoint.orientation_rad) / (2.0 * kPi);
    const double sector = (turn < 0.0 ? turn + 1.0 : turn) * BscDescriptor::kSectors + 0.5;
    if (ring < -0.01 || ring > BscDescriptor::kRings + 0.01) continue;
    on_border |= std::abs(ring - std::round(ring)) < 1e-4 || std::abs(sector - std::round(sector)) < 1e-4;
    if (ring < 0.0 || ring >= BscDescriptor::kRings) continue;
    const auto bit = static_cast<unsigned>(ring) * 16U + static_cast<unsigned>(sector) % 16U;
    descriptor.words[bit / 64U] |= std::uint64_t{1} << (bit % 64U);
  }
  return descriptor;
}

TEST(Bsc, DistanceIsAMetricThatARotationOfBothKeeps) {
  Rng rng(1);
  for (int run = 0; run < 500; ++run) {
    const BscDescriptor a = random_descriptor(rng);
    const BscDescriptor b = random_descriptor(rng);
    const BscDescriptor c = random_descriptor(rng);
    ASSERT_EQ(hamming(a, a), 0);
    ASSERT_EQ(hamming(a, b), hamming(b, a));
    ASSERT_LE(hamming(a, c), hamming(a, b) + hamming(b, c));
    const int k = static_cast<int>(rng.uniform(-40.0, 40.0));
    ASSERT_EQ(hamming(rotated(a, k), rotated(b, k)), hamming(a, b));
    ASSERT_EQ(rotated(rotated(a, k), -k), a);
    ASSERT_EQ(rotated(a, 16), a);
    int differing = 0;
    for (int ring = 0; ring < 8; ++ring)
      for (int sector = 0; sector < 16; ++sector) {
        differing += a.cell(ring, sector) != b.cell(ring, sector) ? 1 : 0;
        ASSERT_EQ(rotated(a, k).cell(ring, ((sector + k) % 16 + 16) % 16), a.cell(ring, sector));
      }
    ASSERT_EQ(hamming(a, b), differing);
    ASSERT_DOUBLE_EQ(distance(a, b), differing / 128.0);
  }
}

TEST(Bsc, IsWhatArcTangentsAndSquareRootsSay) {
  Rng rng(2);
  const RayCaster walls(test::niche_room().segments());
  int compared = 0;
  for (int run = 0; run < 200; ++run) {
    const Pose2 pose{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.0), rng.uniform(-3.0, 3.0)};
    const RawScan raw =
        run % 2 == 0 ? test::sweep(walls, pose, 0.01, rng) : test::circle_sweep(walls, pose, 720);
    const Scan scan = Scan::make(raw).value();
    BscConfig config;
    config.neighbourhood = {.radius_m = rng.uniform(0.1, 2.0), .growth_per_m = run % 3 == 0 ? 0.07 : 0.0};
    for (Keypoint keypoint : test::seen_from(test::niche_room_corners(), pose)) {
      keypoint.orientation_rad = rng.uniform(-3.0, 3.0);
      bool on_border = false;
      const BscDescriptor slow = slow_twin(scan, keypoint, config, on_border);
      if (on_border) continue;
      ++compared;
      ASSERT_EQ(describe_bsc(scan, {&keypoint, 1}, config).front(), slow) << keypoint.point.transpose();
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(Bsc, ATurnedSensorDescribesTheSame) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3.1, 1.7, 0.0};
  const RawScan raw = test::circle_sweep(walls, pose, 1440);
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  const auto still = describe_bsc(Scan::make(raw).value(), corners);
  for (std::size_t beams = 0; beams < 1440; beams += 37) {
    auto turned = corners;
    for (Keypoint& keypoint : turned) {
      const Pose2 turn{0, 0, 2.0 * kPi * static_cast<double>(beams) / 1440};
      keypoint.point = turn * keypoint.point;
      keypoint.orientation_rad = wrap_angle(keypoint.orientation_rad + turn.theta_rad);
    }
    const auto after = describe_bsc(Scan::make(test::turned_by_beams(raw, beams)).value(), turned);
    // Only points within rounding (1e-6) of a cell's border may change sides.
    for (std::size_t k = 0; k < corners.size(); ++k) ASSERT_LE(hamming(still[k], after[k]), 1) << k;
  }
}

TEST(Bsc, OrientationTurnsTheDescriptorBySectors) {
  const RayCaster walls(test::niche_room().segments());
  const Scan scan = Scan::make(test::circle_sweep(walls, {3.1, 1.7, 0.3}, 1440)).value();
  Keypoint keypoint{.point = scan.point(200), .orientation_rad = 0.1};
  const BscDescriptor before = describe_bsc(scan, {&keypoint, 1}).front();
  keypoint.orientation_rad += 3 * 2.0 * kPi / 16;
  EXPECT_LE(hamming(describe_bsc(scan, {&keypoint, 1}).front(), rotated(before, -3)), 1);
  EXPECT_GT(hamming(describe_bsc(scan, {&keypoint, 1}).front(), before), 3);
}

TEST(Bsc, TheSameCornerFromElsewhereIsNearerThanOtherCorners) {
  Rng rng(3);
  const RayCaster walls(test::niche_room().segments());
  const Keypoint concave = test::niche_room_corners()[0];
  const Keypoint convex = test::niche_room_corners()[2];
  for (int run = 0; run < 20; ++run) {
    const auto describe_from = [&](const Pose2& pose) {
      const Scan scan = Scan::make(test::circle_sweep(walls, pose, 1440)).value();
      return describe_bsc(scan, test::seen_from({concave, convex}, pose));
    };
    const auto here = describe_from({rng.uniform(2.0, 3.5), rng.uniform(0.8, 1.8), rng.uniform(-3.0, 3.0)});
    const auto there = describe_from({rng.uniform(2.0, 3.5), rng.uniform(0.8, 1.8), rng.uniform(-3.0, 3.0)});
    EXPECT_LE(distance(here[0], there[0]), kBscSame);
    EXPECT_GT(distance(here[0], there[1]), distance(here[0], there[0]));
  }
}

TEST(Bsc, APointExactlyAtTheRadiusIsOutside) {
  const Scan scan =
      Scan::make(
          {.angle_min_rad = 0.0F, .angle_increment_rad = 0.1F, .range_max_m = 30.0F, .ranges_m = {2.5F}})
          .value();
  const Keypoint keypoint{.point = {2.0, 0.0}};
  EXPECT_EQ(describe_bsc(scan, {&keypoint, 1}).front(), BscDescriptor{});
  BscConfig wider;
  wider.neighbourhood.radius_m = 0.51;
  const BscDescriptor seen = describe_bsc(scan, {&keypoint, 1}, wider).front();
  EXPECT_TRUE(seen.cell(7, 0));
  EXPECT_EQ(hamming(seen, {}), 1);
}

TEST(Bsc, OfNothingIsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Scan scan = Scan::make({.angle_min_rad = 0.0F,
                                .angle_increment_rad = 0.1F,
                                .range_max_m = 30.0F,
                                .ranges_m = {nan, nan, nan}})
                        .value();
  const Keypoint at_the_sensor{};
  EXPECT_EQ(describe_bsc(scan, {&at_the_sensor, 1}).front(), BscDescriptor{});
  EXPECT_TRUE(describe_bsc(scan, {}).empty());
}

TEST(Bsc, AllocatesNothingOnceGrown) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3, 2, 0.3};
  const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  std::vector<BscDescriptor> out;
  describe_bsc(scan, corners, {}, out);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  describe_bsc(scan, corners, {}, out);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
