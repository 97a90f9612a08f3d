// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr FlirtKind kKinds[] = {FlirtKind::range, FlirtKind::normal_blob, FlirtKind::normal_edge,
                                FlirtKind::curvature};

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Beams a quarter of a degree apart, symmetric about straight ahead.
Scan scan_of(std::vector<float> ranges_m) {
  RawScan raw{.angle_increment_rad = static_cast<float>(radians(0.25)),
              .range_min_m = 0.1F,
              .range_max_m = 30.0F,
              .ranges_m = std::move(ranges_m)};
  raw.angle_min_rad = -0.5F * raw.angle_increment_rad * static_cast<float>(raw.ranges_m.size() - 1);
  return Scan::make(raw).value();
}

RawScan room_sweep(const Pose2& pose, double sigma_m, std::uint64_t seed) {
  Rng rng(seed);
  return test::sweep(RayCaster(test::niche_room().segments()), pose, sigma_m, rng);
}

/// 1440 beams all around.
RawScan turn(const Pose2& pose, double sigma_m, std::uint64_t seed) {
  Rng rng(seed);
  const RayCaster walls(test::niche_room().segments());
  RawScan raw{.angle_min_rad = static_cast<float>(-kPi),
              .angle_increment_rad = static_cast<float>(radians(0.25)),
              .range_min_m = 0.1F,
              .range_max_m = 30.0F};
  for (int i = 0; i < 1440; ++i) {
    const double bearing = pose.theta_rad - kPi + i * radians(0.25);
    const auto hit = walls.cast(pose.translation(), {std::cos(bearing), std::sin(bearing)}, 30.0);
    raw.ranges_m.push_back(static_cast<float>(hit->range_m + rng.normal(sigma_m)));
  }
  return raw;
}

std::vector<Keypoint> by_beam(std::vector<Keypoint> keypoints) {
  std::sort(keypoints.begin(), keypoints.end(),
            [](const Keypoint& a, const Keypoint& b) { return a.beam < b.beam; });
  return keypoints;
}

/// Beams before `at` at one range, the others at another.
std::vector<float> step(std::size_t size, std::size_t at, float before_m, float behind_m) {
  std::vector<float> ranges_m(size, behind_m);
  std::fill_n(ranges_m.begin(), at, before_m);
  return ranges_m;
}

TEST(FlirtRange, AStepIsOneKeypointAtItsNearSide) {
  for (const auto& [before_m, behind_m, beam] :
       {std::tuple(2.0F, 3.0F, 149U), std::tuple(3.0F, 2.0F, 150U)}) {
    const auto keypoints = detect_flirt(scan_of(step(300, 150, before_m, behind_m)));
    ASSERT_EQ(keypoints.size(), 1U);
    EXPECT_EQ(keypoints[0].beam, beam);
    EXPECT_NEAR(keypoints[0].point.norm(), 2.0, 1e-6);
  }
}

TEST(FlirtRange, TwoSurfacesWithABeamLostBetweenThemAreNoStep) {
  std::vector<float> ranges_m = step(300, 150, 2.0F, 3.0F);
  ranges_m[150] = kNone;
  EXPECT_TRUE(detect_flirt(scan_of(ranges_m)).empty());
}

TEST(FlirtRange, TheScaleGrowsWithTheBump) {
  double before_m = 0.0;
  for (const double width_beams : {1.5, 3.0, 6.0}) {
    std::vector<float> ranges_m;
    ranges_m.reserve(401);
    for (int i = 0; i < 401; ++i)
      ranges_m.push_back(
          static_cast<float>(4.0 - 0.2 * std::exp(-0.5 * std::pow((i - 200) / width_beams, 2))));
    FlirtConfig config = flirt_defaults(FlirtKind::range);
    config.scales_count = 8;
    const auto keypoints = detect_flirt(scan_of(ranges_m), config);
    ASSERT_FALSE(keypoints.empty());
    EXPECT_EQ(keypoints[0].beam, 200U);
    EXPECT_GT(keypoints[0].scale_m, before_m);
    before_m = keypoints[0].scale_m;
  }
}

TEST(FlirtNormals, ACornerIsAnEdge) {
  Rng rng(1);
  // Seen from the middle of a room; the corners ahead are those at (4, 3) and (4, 0).
  const Scan scan =
      Scan::make(test::sweep(RayCaster(test::rectangle(4, 3).segments()), {2, 1.5, 0}, 0.0, rng)).value();
  const auto keypoints = by_beam(detect_flirt(scan, flirt_defaults(FlirtKind::normal_edge)));
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(2, -1.5), Eigen::Vector2d(2, 1.5)}) {
    const auto at = std::count_if(keypoints.begin(), keypoints.end(), [&](const Keypoint& keypoint) {
      return (keypoint.point - corner).norm() < 0.03;  // a beam or two: they are 1.3 cm apart there
    });
    EXPECT_EQ(at, 1);
  }
  // The flirtlib rule keeps one sign, and it is not that of a room's corners.
  FlirtConfig falling = flirt_defaults(FlirtKind::normal_edge);
  falling.falling_only = true;
  EXPECT_TRUE(detect_flirt(scan, falling).empty());
}

TEST(FlirtNormals, AnEdgePointsAlongTheBisector) {
  Rng rng(1);
  const Scan scan =
      Scan::make(test::sweep(RayCaster(test::rectangle(4, 4).segments()), {2, 2, 0}, 0.0, rng)).value();
  for (const Keypoint& keypoint : detect_flirt(scan, flirt_defaults(FlirtKind::normal_edge)))
    EXPECT_NEAR(wrap_angle(keypoint.orientation_rad - std::atan2(keypoint.point.y(), keypoint.point.x())),
                0.0, 0.1);  // a beam beside the corner turns the window's normal by up to this
}

TEST(FlirtCurvature, ACornerIsAKeypointThatPointsIntoTheRoom) {
  Rng rng(1);
  const Scan scan =
      Scan::make(test::sweep(RayCaster(test::rectangle(4, 3).segments()), {2, 1.5, 0}, 0.0, rng)).value();
  const auto keypoints = by_beam(detect_flirt(scan, flirt_defaults(FlirtKind::curvature)));
  ASSERT_GE(keypoints.size(), 2U);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(2, -1.5), Eigen::Vector2d(2, 1.5)}) {
    const auto near =
        std::min_element(keypoints.begin(), keypoints.end(), [&](const Keypoint& a, const Keypoint& b) {
          return (a.point - corner).squaredNorm() < (b.point - corner).squaredNorm();
        });
    EXPECT_LT((near->point - corner).norm(), 0.06);
    EXPECT_NEAR(near->orientation_rad, corner.y() > 0.0 ? -0.75 * kPi : 0.75 * kPi, 0.2);
    EXPECT_GE(near->scale_m, 0.4);
  }
}

TEST(Flirt, PlainWallsAndCirclesHaveNothing) {
  std::vector<float> wall;
  wall.reserve(401);
  for (int i = -200; i <= 200; ++i) wall.push_back(static_cast<float>(2.0 / std::cos(i * radians(0.25))));
  RawScan circle{.angle_min_rad = static_cast<float>(-kPi),
                 .angle_increment_rad = static_cast<float>(radians(0.25)),
                 .range_min_m = 0.1F,
                 .range_max_m = 30.0F};
  circle.ranges_m.assign(1440, 5.0F);
  for (const FlirtKind kind : kKinds) {
    EXPECT_TRUE(detect_flirt(scan_of(wall), flirt_defaults(kind)).empty());
    EXPECT_TRUE(detect_flirt(Scan::make(circle).value(), flirt_defaults(kind)).empty());
  }
}

TEST(Flirt, TurningTheSensorByWholeBeamsShiftsTheResults) {
  const RawScan raw = turn({2.6, 1.7, 0.2}, 0.01, 4);
  const Scan scan = Scan::make(raw).value();
  ASSERT_TRUE(scan.is_full_circle());
  for (const FlirtKind kind : {FlirtKind::range, FlirtKind::normal_blob, FlirtKind::normal_edge}) {
    const auto before = detect_flirt(scan, flirt_defaults(kind));
    ASSERT_GE(before.size(), 5U);
    for (const std::size_t shift : {1U, 360U, 719U, 1000U}) {
      RawScan turned = raw;
      std::rotate(turned.ranges_m.begin(), turned.ranges_m.begin() + static_cast<std::ptrdiff_t>(shift),
                  turned.ranges_m.end());
      const auto after = detect_flirt(Scan::make(turned).value(), flirt_defaults(kind));
      ASSERT_EQ(after.size(), before.size()) << static_cast<int>(kind) << " " << shift;
      for (const Keypoint& keypoint : before) {
        // Directions of up to 10 rad are floats; coarse second derivatives multiply their rounding to 1e-4,
        // and may prefer the beam beside where two are as good as equal.
        const Eigen::Rotation2Dd back(static_cast<double>(shift) * radians(0.25));
        const auto same = std::find_if(after.begin(), after.end(), [&](const Keypoint& k) {
          return (back * k.point - keypoint.point).norm() < 0.03;
        });
        ASSERT_NE(same, after.end()) << static_cast<int>(kind) << " " << keypoint.beam;
        const std::size_t beams_off = (same->beam + shift + 1440 + 1 - keypoint.beam) % 1440;
        EXPECT_LE(beams_off, 2U) << static_cast<int>(kind) << " " << keypoint.beam;
        EXPECT_NEAR(same->score, keypoint.score, 1e-3);
        EXPECT_NEAR(same->scale_m, keypoint.scale_m, 0.03);
        EXPECT_NEAR(wrap_angle(same->orientation_rad - keypoint.orientation_rad +
                               static_cast<double>(shift) * radians(0.25)),
                    0.0, 0.03);
      }
    }
  }
}

TEST(FlirtCurvature, TurningTheSensorByWholeBeamsHardlyMoves) {
  // The contour is sampled from where it begins, so that places differ by parts of a sample; and t exp(-t) is
  // so flat at its top that the noise of single points decides between peaks side by side.
  const RawScan raw = turn({2.6, 1.7, 0.2}, 0.0, 4);
  const auto before = detect_flirt(Scan::make(raw).value(), flirt_defaults(FlirtKind::curvature));
  ASSERT_GE(before.size(), 8U);  // seven corners of the room are seen, and two of the pillar
  for (const std::size_t shift : {1U, 360U, 719U, 1000U}) {
    RawScan turned = raw;
    std::rotate(turned.ranges_m.begin(), turned.ranges_m.begin() + static_cast<std::ptrdiff_t>(shift),
                turned.ranges_m.end());
    const auto after = detect_flirt(Scan::make(turned).value(), flirt_defaults(FlirtKind::curvature));
    const Eigen::Rotation2Dd back(static_cast<double>(shift) * radians(0.25));
    for (const Keypoint& keypoint : before)
      EXPECT_TRUE(
          std::any_of(after.begin(), after.end(),
                      [&](const Keypoint& k) { return (back * k.point - keypoint.point).norm() < 0.05; }))
          << shift << " " << keypoint.beam;
  }
}

TEST(Flirt, AMirroredScanHasMirroredKeypoints) {
  RawScan raw = room_sweep({3, 2, 0.4}, 0.01, 8);
  const Scan scan = Scan::make(raw).value();
  std::reverse(raw.ranges_m.begin(), raw.ranges_m.end());
  const Scan mirror = Scan::make(raw).value();
  for (const FlirtKind kind : {FlirtKind::range, FlirtKind::normal_blob, FlirtKind::normal_edge}) {
    const auto keypoints = by_beam(detect_flirt(scan, flirt_defaults(kind)));
    auto mirrored = by_beam(detect_flirt(mirror, flirt_defaults(kind)));
    std::reverse(mirrored.begin(), mirrored.end());
    ASSERT_EQ(keypoints.size(), mirrored.size());
    for (std::size_t i = 0; i < keypoints.size(); ++i)
      EXPECT_EQ(keypoints[i].beam, scan.size() - 1 - mirrored[i].beam);
  }
}

TEST(Flirt, KeypointsKeepTheirDistance) {
  const Scan scan = Scan::make(turn({2.6, 1.7, 0.2}, 0.01, 4)).value();
  for (const FlirtKind kind : kKinds) {
    const auto keypoints = detect_flirt(scan, flirt_defaults(kind));
    for (std::size_t i = 0; i < keypoints.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT((keypoints[i].point - keypoints[j].point).norm(), 0.2);
    if (kind == FlirtKind::curvature) continue;
    EXPECT_TRUE(std::is_sorted(keypoints.begin(), keypoints.end(),
                               [](const Keypoint& a, const Keypoint& b) { return a.score > b.score; }));
  }
}

void expect_sane(const Scan& scan, const std::vector<Keypoint>& keypoints) {
  for (const Keypoint& keypoint : keypoints) {
    ASSERT_LT(keypoint.beam, scan.size());
    EXPECT_TRUE(scan.is_hit(keypoint.beam));
    EXPECT_TRUE(keypoint.point.allFinite());
    EXPECT_TRUE(std::isfinite(keypoint.score));
    EXPECT_TRUE(std::isfinite(keypoint.scale_m));
    EXPECT_GE(keypoint.orientation_rad, -kPi);
    EXPECT_LT(keypoint.orientation_rad, kPi);
  }
}

TEST(Flirt, LostBeamsAndShortStretchesDoNoHarm) {
  Rng rng(2);
  for (const double lost : {0.3, 0.7, 0.99, 1.0})
    for (const bool circle : {false, true}) {
      RawScan raw = circle ? turn({2.6, 1.7, 0.2}, 0.01, 4) : room_sweep({3, 2, 0.4}, 0.01, 8);
      for (float& range : raw.ranges_m)
        if (rng.uniform() < lost) range = kNone;
      const Scan scan = Scan::make(raw).value();
      for (const FlirtKind kind : kKinds) {
        expect_sane(scan, detect_flirt(scan, flirt_defaults(kind)));
        expect_sane(scan, detect_flirt(scan, flirtlib_tools(kind)));
      }
    }
}

TEST(Flirt, PoorScansAreNoTrouble) {
  RawScan one_place{.angle_increment_rad = 2e-6F, .range_min_m = 0.1F, .range_max_m = 30.0F};
  one_place.ranges_m.assign(50, 2.0F);
  for (const FlirtKind kind : kKinds) {
    for (const std::size_t beams : {1U, 2U, 3U, 7U}) {
      EXPECT_TRUE(detect_flirt(scan_of(std::vector<float>(beams, 2.0F)), flirt_defaults(kind)).empty());
      EXPECT_TRUE(detect_flirt(scan_of(std::vector<float>(beams, kNone)), flirt_defaults(kind)).empty());
    }
    EXPECT_TRUE(detect_flirt(Scan::make(one_place).value(), flirt_defaults(kind)).empty());
    RawScan few_around{.angle_increment_rad = static_cast<float>(0.5 * kPi), .range_max_m = 30.0F};
    few_around.ranges_m = {1.0F, 2.0F, 3.0F, 4.0F};
    const Scan scan = Scan::make(few_around).value();
    expect_sane(scan, detect_flirt(scan, flirt_defaults(kind)));
  }
}

TEST(Flirt, TheSameScanGivesTheSameWhateverCameBefore) {
  FlirtScratch scratch;
  std::vector<Keypoint> keypoints;
  const Scan scan = Scan::make(room_sweep({3, 2, 0.4}, 0.01, 8)).value();
  const Scan other = Scan::make(turn({2.6, 1.7, 0.2}, 0.01, 4)).value();
  for (const FlirtKind kind : kKinds)
    for (const FlirtConfig& config : {flirt_defaults(kind), flirtlib_tools(kind)}) {
      detect_flirt(other, config, scratch, keypoints);
      detect_flirt(scan, config, scratch, keypoints);
      EXPECT_EQ(keypoints, detect_flirt(scan, config));
    }
}

TEST(Flirt, AllocatesNothingPerScan) {
  const Scan scans[] = {Scan::make(room_sweep({3, 2, 0.4}, 0.01, 8)).value(),
                        Scan::make(turn({2.6, 1.7, 0.2}, 0.01, 4)).value(),
                        Scan::make(room_sweep({1, 1, 1.4}, 0.01, 9)).value()};
  for (const FlirtKind kind : kKinds) {
    const FlirtConfig config = flirt_defaults(kind);
    FlirtScratch scratch;
    std::vector<Keypoint> keypoints;
    for (const Scan& scan : scans) detect_flirt(scan, config, scratch, keypoints);
    const std::size_t before = test::allocations();
    ASSERT_GT(before, 0U) << "the counter does not count";
    for (const Scan& scan : scans) detect_flirt(scan, config, scratch, keypoints);
    EXPECT_EQ(test::allocations(), before) << static_cast<int>(kind);
  }
}

TEST(Flirt, PeaksAcrossScalesAreSomeOfThePeaks) {
  const Scan scan = Scan::make(room_sweep({3, 2, 0.4}, 0.01, 8)).value();
  for (const FlirtKind kind : kKinds) {
    FlirtConfig config = flirt_defaults(kind);
    config.suppress_m = 0.0;
    const std::size_t all = detect_flirt(scan, config).size();
    config.peaks_across_scales = true;
    const std::size_t across = detect_flirt(scan, config).size();
    EXPECT_LE(across, all);
    EXPECT_GT(across, 0U);
  }
}

TEST(FlirtConfig, DefaultsAndTheToolsAreAllowed) {
  for (const FlirtKind kind : kKinds) {
    EXPECT_TRUE(check_config(flirt_defaults(kind)));
    EXPECT_TRUE(check_config(flirtlib_tools(kind)));
  }
}

}  // namespace
}  // namespace beaconless
