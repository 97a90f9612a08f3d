// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/segment_by_distance.hpp"

#include <gmock/gmock.h>

#include "tests/features/made_scans.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using test::Fan;
using test::kFullCircle;
using test::scan_of;

const std::vector<DistanceThreshold> kAll = {DistanceThreshold::constant, DistanceThreshold::dietmayer,
                                             DistanceThreshold::santos, DistanceThreshold::borges_aldon,
                                             DistanceThreshold::lee};

/// Cuts where the law of cosines says so, one pair after the other, and joins over the end of a full circle.
std::vector<ScanSegment> slow_twin(const Scan& scan, const DistanceSegmentationConfig& config) {
  const std::size_t n = scan.size();
  const auto parted = [&](std::size_t i, std::size_t j) {
    if (!scan.is_hit(i) || !scan.is_hit(j)) return true;
    const double r = scan.ranges_m()[i];
    const double q = scan.ranges_m()[j];
    if (config.threshold == DistanceThreshold::lee) return std::abs(r - q) / (r + q) > config.lee_ratio;
    const double step = scan.angle_increment_rad();
    return std::sqrt(r * r + q * q - 2 * r * q * std::cos(step)) >
           distance_threshold_m(config, step, std::min(r, q));
  };
  std::vector<ScanSegment> segments;
  for (std::size_t i = 0; i < n; ++i) {
    if (!scan.is_hit(i)) continue;
    if (i == 0 || parted(i - 1, i)) segments.push_back({i, 0});
    ++segments.back().count;
  }
  if (scan.is_full_circle() && segments.size() > 1 && segments.front().first == 0 && !parted(n - 1, 0)) {
    segments.back().count += segments.front().count;
    segments.erase(segments.begin());
  }
  return segments;
}

Scan random_scan(const Fan& fan, Rng& rng) {
  double range = 3.0;
  return scan_of(fan, [&](int, double) {
    if (rng.uniform() < 0.05) range = rng.uniform(0.3, 12.0);
    if (rng.uniform() < 0.03) return 0.0;
    return range += rng.normal(0.02);
  });
}

TEST(SegmentByDistance, AgreesWithItsSlowTwin) {
  Rng rng(1);
  for (int run = 0; run < 100; ++run)
    for (const Fan& fan : {Fan{}, kFullCircle}) {
      const Scan scan = random_scan(fan, rng);
      for (const DistanceThreshold threshold : kAll) {
        const DistanceSegmentationConfig config{.threshold = threshold};
        ASSERT_EQ(segment_by_distance(scan, config), slow_twin(scan, config)) << static_cast<int>(threshold);
      }
    }
}

TEST(SegmentByDistance, NeighboursOnACircleAreC1RApart) {
  const double r = 4.0;
  const double step = radians(0.25);
  const double c1_r = 2.0 * r * std::sin(step / 2.0);
  const Scan circle = scan_of({}, [&](int, double) { return r; });
  for (const double above : {1.001, 0.999}) {
    const auto segments =
        segment_by_distance(circle, {.threshold = DistanceThreshold::constant, .constant_m = c1_r * above});
    EXPECT_EQ(segments.size(), above > 1.0 ? 1U : 1081U);
  }
  const DistanceSegmentationConfig dietmayer{.threshold = DistanceThreshold::dietmayer, .sigma_m = 0.0};
  EXPECT_NEAR(distance_threshold_m(dietmayer, step, r), c1_r, 1e-15);
}

TEST(SegmentByDistance, NeighboursOnAWallAreApartByTheTangents) {
  const double h = 2.0;
  const double step = radians(0.25);
  const Fan fan{.beams = 321, .first_deg = -40.0};
  const Scan wall = scan_of(fan, [&](int, double bearing) { return h / std::cos(bearing); });
  for (const int k : {200, 230, 270, 310}) {
    // Everything nearer to head-on than pair k stays whole at its distance.
    const double theta = radians(-40.0 + 0.25 * k);
    const double apart = h * std::abs(std::tan(theta + step) - std::tan(theta));
    const auto segments = segment_by_distance(
        wall, {.threshold = DistanceThreshold::constant, .constant_m = apart * 1.0005, .min_beams = 2});
    ASSERT_EQ(segments.size(), 1U);
    EXPECT_EQ(segments[0].first + segments[0].count - 1, static_cast<std::size_t>(k + 1));
  }
}

// ALGORITHMS: chords at r = 5 m and 0.25 deg. The printed forms give 3.9, 21.9, 124 and 1253 (or 1428) mm.
TEST(SegmentByDistance, SantosIsTheChordOfTheTurnedWall) {
  const double step = radians(0.25);
  for (const auto& [beta_deg, chord_m] :
       {std::pair{10.0, 0.0222}, {45.0, 0.0309}, {80.0, 0.1272}, {89.0, 1.429}}) {
    const DistanceSegmentationConfig santos{
        .threshold = DistanceThreshold::santos, .sigma_m = 0.0, .beta_deg = beta_deg};
    EXPECT_NEAR(distance_threshold_m(santos, step, 5.0), chord_m, 0.0006 * (1.0 + chord_m)) << beta_deg;
    // The same as Borges-Aldon with lambda = 90 deg + step/2 - beta.
    const DistanceSegmentationConfig borges{.threshold = DistanceThreshold::borges_aldon,
                                            .sigma_m = 0.0,
                                            .lambda_deg = 90.0 + degrees(step) / 2.0 - beta_deg};
    EXPECT_NEAR(distance_threshold_m(borges, step, 5.0), distance_threshold_m(santos, step, 5.0), 1e-12);
  }
}

TEST(SegmentByDistance, AWallMetAtBetaIsJustWhole) {
  const double beta = radians(60.0);
  const double step = radians(0.25);
  // A wall turned by beta from the chord of equal ranges between beams 100 and 101.
  const Fan fan{.beams = 201, .first_deg = 0.0};
  const double at = radians(0.25 * 100.5);
  const Scan wall = scan_of(fan, [&](int, double bearing) { return 5.0 / std::cos(bearing - at + beta); });
  for (const double beta_deg : {59.5, 60.5}) {
    const auto segments = segment_by_distance(
        wall, {.threshold = DistanceThreshold::santos, .sigma_m = 0.0, .beta_deg = beta_deg, .min_beams = 2});
    ASSERT_EQ(segments.size(), 1U) << beta_deg << step;
    const std::size_t last = segments[0].first + segments[0].count - 1;
    if (beta_deg < 60.0)
      EXPECT_LE(std::min(segments[0].first, 200 - last), 101U);
    else
      EXPECT_TRUE(segments[0].first <= 100 && last >= 101);
  }
}

TEST(SegmentByDistance, ALargerThresholdNeverMakesMoreSegments) {
  Rng rng(2);
  const RayCaster walls(test::niche_room().segments());
  const Scan scan = test::seen(walls, {3, 2, 0.3}, 0.01, rng);
  std::size_t before = scan.size() + 1;
  std::size_t first = 0;
  for (double threshold = 0.001; threshold < 20.0; threshold *= 1.2) {
    const auto segments =
        segment_by_distance(scan, {.threshold = DistanceThreshold::constant, .constant_m = threshold});
    EXPECT_LE(segments.size(), before) << threshold;
    if (first == 0) first = segments.size();
    before = segments.size();
  }
  EXPECT_GT(first, 900U);
  EXPECT_EQ(before, 1U);
}

TEST(SegmentByDistance, TurningTheSensorTurnsTheSegments) {
  Rng rng(3);
  for (int run = 0; run < 20; ++run) {
    const Scan scan = random_scan(kFullCircle, rng);
    const auto by = static_cast<std::size_t>(rng.uniform(1, 1439));
    auto expected = segment_by_distance(scan);
    for (ScanSegment& segment : expected) segment.first = (segment.first + scan.size() - by) % scan.size();
    EXPECT_THAT(segment_by_distance(test::turned(scan, by)), testing::UnorderedElementsAreArray(expected));
  }
}

TEST(SegmentByDistance, AClosedContourBeginsAtItsFarthestBeam) {
  const Scan room = scan_of(kFullCircle, [](int i, double) { return i == 777 ? 2.01 : 2.0; });
  const auto segments = segment_by_distance(room);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0], (ScanSegment{777, 1440}));
}

TEST(SegmentByDistance, NoHitsNoSegments) {
  for (const int beams : {1, 2, 3, 1081}) {
    const Scan nothing = scan_of({.beams = beams}, [](int, double) { return 0.0; });
    EXPECT_TRUE(segment_by_distance(nothing).empty());
    const Scan all = scan_of({.beams = beams}, [](int, double) { return 1.0; });
    EXPECT_EQ(segment_by_distance(all), (std::vector<ScanSegment>{{0, static_cast<std::size_t>(beams)}}));
  }
  const Scan one = scan_of(kFullCircle, [](int i, double) { return i == 5 ? 1.0 : 0.0; });
  EXPECT_EQ(segment_by_distance(one), (std::vector<ScanSegment>{{5, 1}}));
}

TEST(SegmentByDistance, ABeamThatIsNoHitCuts) {
  const Scan scan = scan_of({}, [](int i, double) { return i == 500 ? 0.0 : 2.0; });
  EXPECT_EQ(segment_by_distance(scan), (std::vector<ScanSegment>{{0, 500}, {501, 580}}));
  EXPECT_EQ(segment_by_distance(scan, {.min_beams = 501}), (std::vector<ScanSegment>{{501, 580}}));
}

TEST(SegmentByDistance, AllocatesNothingPerScan) {
  Rng rng(4);
  std::vector<Scan> scans;
  for (int i = 0; i < 10; ++i) scans.push_back(random_scan({}, rng));
  DistanceSegmentationScratch scratch;
  std::vector<ScanSegment> segments;
  for (const Scan& scan : scans) segment_by_distance(scan, {}, scratch, segments);
  const std::size_t before = test::allocations();
  for (const Scan& scan : scans) segment_by_distance(scan, {}, scratch, segments);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace beaconless
