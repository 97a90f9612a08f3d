// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/interest_regions.hpp"

#include <gtest/gtest.h>

#include "beaconless/geometry/pose2.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// A sweep with dropped beams, over 270 degrees or, turned to `first_deg`, over a full circle.
Scan room_scan(Rng& rng, bool full_circle, double dropped_share) {
  const RayCaster walls(test::niche_room().segments());
  const Pose2 pose{rng.uniform(1.0, 5.0), rng.uniform(1.0, 3.0), rng.uniform(-3.0, 3.0)};
  RawScan raw = test::sweep(walls, pose, 0.01, rng);
  if (full_circle) {
    raw.angle_min_rad = static_cast<float>(rng.uniform(-7.0, 7.0));
    raw.angle_increment_rad = static_cast<float>(2.0 * kPi / 720);
    raw.ranges_m.resize(720);
    for (std::size_t i = 0; i < 720; ++i) {
      const double bearing = static_cast<double>(raw.angle_min_rad) +
                             static_cast<double>(i) * static_cast<double>(raw.angle_increment_rad);
      const auto hit = walls.cast(pose.translation(), {std::cos(bearing), std::sin(bearing)}, 30.0);
      raw.ranges_m[i] = static_cast<float>(hit->range_m);
    }
  }
  for (float& range : raw.ranges_m)
    if (rng.uniform() < dropped_share) range = std::numeric_limits<float>::quiet_NaN();
  return Scan::make(raw).value();
}

std::vector<Keypoint> some_keypoints(const Scan& scan, Rng& rng, int count) {
  std::vector<Keypoint> keypoints;
  while (static_cast<int>(keypoints.size()) < count) {
    const auto beam = static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(scan.size())));
    if (scan.is_hit(beam)) keypoints.push_back({.beam = beam, .point = scan.point(beam)});
  }
  return keypoints;
}

TEST(InterestRegions, AreTheHitsWithinTheRadiusOfAnyKeypointOnEveryScan) {
  Rng rng(1);
  InterestRegions regions;
  for (int run = 0; run < 60; ++run) {
    const Scan scan = room_scan(rng, run % 2 == 0, run % 3 == 0 ? 0.3 : 0.0);
    const auto keypoints = some_keypoints(scan, rng, run % 7);
    const InterestRegionsConfig config{{.radius_m = rng.uniform(0.05, 3.0)}};
    find_interest_regions(scan, keypoints, config, regions);

    ASSERT_EQ(regions.mask.size(), scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
      double nearest = 1e9;
      for (const Keypoint& keypoint : keypoints)
        nearest = std::min(nearest, (scan.point(i) - keypoint.point).norm());
      if (std::abs(nearest - config.neighbourhood.radius_m) < 1e-5) continue;
      ASSERT_EQ(regions.mask[i] != 0, scan.is_hit(i) && nearest < config.neighbourhood.radius_m) << i;
    }
  }
}

TEST(InterestRegions, SayTheSameInAllThreeForms) {
  Rng rng(2);
  int over_the_end = 0;
  for (int run = 0; run < 60; ++run) {
    const Scan scan = room_scan(rng, run % 2 == 0, run % 3 == 0 ? 0.3 : 0.0);
    auto keypoints = some_keypoints(scan, rng, 6);
    keypoints.push_back({.point = scan.point(0)});
    const auto regions = find_interest_regions(scan, keypoints);
    std::vector<std::uint8_t> by_segments(scan.size(), 0);
    for (const ScanSegment& segment : regions.segments) {
      over_the_end += segment.first + segment.count > scan.size() ? 1 : 0;
      for (std::size_t k = 0; k < segment.count; ++k) {
        ASSERT_EQ(by_segments[segment.beam(k, scan.size())], 0) << "twice";
        by_segments[segment.beam(k, scan.size())] = 1;
      }
    }
    ASSERT_EQ(by_segments, regions.mask);
    std::vector<std::uint8_t> by_beams(scan.size(), 0);
    for (std::size_t k = 0; k < regions.beams.size(); ++k) {
      if (k > 0) {
        ASSERT_LT(regions.beams[k - 1], regions.beams[k]);
      }
      by_beams[regions.beams[k]] = 1;
    }
    ASSERT_EQ(by_beams, regions.mask);
  }
  EXPECT_GT(over_the_end, 5);
}

TEST(InterestRegions, ThatOverlapAreOne) {
  Rng rng(3);
  const Scan scan = room_scan(rng, false, 0.0);
  const Keypoint one{.point = scan.point(500)};
  const Keypoint other{.point = scan.point(505)};
  const auto both = find_interest_regions(scan, std::vector<Keypoint>{one, other, one});
  const auto alone = find_interest_regions(scan, std::vector<Keypoint>{one});
  EXPECT_EQ(both.segments.size(), alone.segments.size());
  EXPECT_GE(both.beams.size(), alone.beams.size());
  EXPECT_LT(both.beams.size(), 2 * alone.beams.size());
}

TEST(InterestRegions, OfNothingAreEmpty) {
  const auto nothing = Scan::make({.angle_min_rad = 0.0F,
                                   .angle_increment_rad = 0.01F,
                                   .range_max_m = 30.0F,
                                   .ranges_m = {0.0F, std::numeric_limits<float>::infinity()}})
                           .value();
  const Keypoint keypoint{};  // at the sensor itself, where beams that are no hits have their points
  EXPECT_TRUE(find_interest_regions(nothing, std::vector<Keypoint>{keypoint}).beams.empty());
  EXPECT_TRUE(find_interest_regions(nothing, {}).segments.empty());
  Rng rng(4);
  const Scan scan = room_scan(rng, false, 0.0);
  const Keypoint odd{.point = {std::numeric_limits<double>::quiet_NaN(), 1.0}};
  EXPECT_TRUE(find_interest_regions(scan, std::vector<Keypoint>{odd}).beams.empty());
}

TEST(InterestRegions, AllocateNothingOnceGrown) {
  Rng rng(5);
  InterestRegions regions;
  std::vector<Scan> scans;
  std::vector<std::vector<Keypoint>> keypoints;
  for (int run = 0; run < 10; ++run) {
    scans.push_back(room_scan(rng, false, 0.1));
    keypoints.push_back(some_keypoints(scans.back(), rng, 3 + run));
  }
  find_interest_regions(scans[0], keypoints[0], {}, regions);
  const std::size_t before = test::allocations();
  ASSERT_GT(before, 0U) << "the counter does not count";
  for (std::size_t run = 1; run < scans.size(); ++run)
    find_interest_regions(scans[run], keypoints[run], {}, regions);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
