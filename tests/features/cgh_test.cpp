// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/cgh.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "descriptor_scenes.hpp"
#include "tests/support/allocations.hpp"

namespace beaconless {
namespace {

double sum_of(const CghDescriptor& descriptor) {
  return std::accumulate(descriptor.bins.begin(), descriptor.bins.end(), 0.0);
}

CghDescriptor random_descriptor(Rng& rng) {
  CghDescriptor descriptor;
  for (float& bin : descriptor.bins) bin = static_cast<float>(rng.uniform());
  const auto sum = static_cast<float>(sum_of(descriptor));
  for (float& bin : descriptor.bins) bin /= sum;
  return descriptor;
}

TEST(Cgh, DistanceIsSymmetricAndKeptByARotationOfBoth) {
  Rng rng(1);
  for (int run = 0; run < 200; ++run) {
    const CghDescriptor a = random_descriptor(rng);
    const CghDescriptor b = random_descriptor(rng);
    const int k = static_cast<int>(rng.uniform(-40.0, 40.0));
    ASSERT_EQ(distance(a, a), 0.0);
    ASSERT_EQ(distance(a, b), distance(b, a));
    ASSERT_GT(distance(a, b), 0.0);
    ASSERT_NEAR(distance(rotated(a, k), rotated(b, k)), distance(a, b), 1e-6);
    ASSERT_EQ(rotated(rotated(a, k), -k), a);
  }
}

TEST(Cgh, IsWhatArcTangentsSay) {
  Rng rng(2);
  const RayCaster walls(test::niche_room().segments());
  for (int run = 0; run < 100; ++run) {
    const Pose2 pose{rng.uniform(0.5, 5.5), rng.uniform(0.5, 3.0), rng.uniform(-3.0, 3.0)};
    const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
    for (Keypoint keypoint : test::seen_from(test::niche_room_corners(), pose)) {
      keypoint.orientation_rad = rng.uniform(-3.0, 3.0);
      std::array<double, 16> slow{};
      double all = 0.0;
      for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector2d to = scan.point(i) - keypoint.point;
        if (!scan.is_hit(i) || to.norm() < 0.02 || to.norm() >= 0.5) continue;
        const double turn = wrap_angle(std::atan2(to.y(), to.x()) - keypoint.orientation_rad) / (2.0 * kPi);
        const auto bin = static_cast<std::size_t>(std::floor(turn * 16.0 + 16.5)) % 16;
        slow[bin] += 5.0;
        slow[(bin + 1) % 16] += 1.0;
        slow[(bin + 15) % 16] += 1.0;
        all += 7.0;
      }
      const CghDescriptor fast = describe_cgh(scan, {&keypoint, 1}).front();
      ASSERT_NEAR(sum_of(fast), 1.0, 1e-6);
      // One point within rounding of a border moves 10 / 7 of a point.
      for (std::size_t bin = 0; bin < 16; ++bin)
        ASSERT_NEAR(static_cast<double>(fast.bins[bin]), all > 0.0 ? slow[bin] / all : 1.0 / 16.0,
                    all > 0.0 ? 5.1 / all : 1e-6);
    }
  }
}

TEST(Cgh, ATurnedSensorDescribesTheSame) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3.1, 1.7, 0.0};
  const RawScan raw = test::circle_sweep(walls, pose, 1440);
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  const auto still = describe_cgh(Scan::make(raw).value(), corners);
  for (std::size_t beams = 0; beams < 1440; beams += 37) {
    const auto turned = test::seen_from(corners, {0, 0, -2.0 * kPi * static_cast<double>(beams) / 1440});
    const auto after = describe_cgh(Scan::make(test::turned_by_beams(raw, beams)).value(), turned);
    for (std::size_t k = 0; k < corners.size(); ++k) ASSERT_LT(distance(still[k], after[k]), 0.01) << k;
  }
}

TEST(Cgh, OfNothingIsUniform) {
  const Scan scan = Scan::make({.angle_min_rad = 0.0F,
                                .angle_increment_rad = 0.1F,
                                .range_max_m = 30.0F,
                                .ranges_m = {5.0F, 5.0F}})
                        .value();
  const Keypoint keypoint{.point = {2.0, 0.0}};
  const auto uniform = describe_cgh(scan, {&keypoint, 1}).front();
  EXPECT_EQ(uniform.bins.front(), 1.0F / 16.0F);
  EXPECT_NEAR(sum_of(uniform), 1.0, 1e-6);
}

TEST(Cgh, AllocatesNothingOnceGrown) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{3, 2, 0.3};
  const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
  const auto corners = test::seen_from(test::niche_room_corners(), pose);
  std::vector<CghDescriptor> out;
  describe_cgh(scan, corners, {}, out);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  describe_cgh(scan, corners, {}, out);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
