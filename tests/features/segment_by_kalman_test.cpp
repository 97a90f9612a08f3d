// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/segment_by_kalman.hpp"

#include <gmock/gmock.h>

#include "tests/features/made_scans.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using test::kFullCircle;
using test::scan_of;

TEST(SegmentByKalman, AWallIsOneSegmentHoweverFlatlyItIsMet) {
  Rng rng(1);
  int cuts = 0;
  for (int run = 0; run < 50; ++run) {
    const double normal = radians(rng.uniform(-60.0, 60.0));
    const double distance = rng.uniform(0.5, 4.0);
    const Scan wall = scan_of({.beams = 121, .first_deg = -15.0}, [&](int, double bearing) {
      return distance / std::cos(bearing - normal) + rng.normal(0.01);
    });
    cuts += static_cast<int>(segment_by_kalman(wall).size()) - 1;
  }
  // Of 6000 beams, a gate of four sigmas cuts 0.4 for nothing.
  EXPECT_LE(cuts, 4);
}

TEST(SegmentByKalman, CutsAtJumpsAndAtCorners) {
  Rng rng(2);
  const RayCaster walls(test::rectangle(4, 3).segments());
  for (int run = 0; run < 20; ++run) {
    const Scan scan = test::seen(walls, {2, 1.5, 0.0}, 0.003, rng);
    const auto segments = segment_by_kalman(scan, {.sigma_m = 0.003, .min_beams = 10});
    // Corners at ±36.87° and one at ±143° is out of sight: three walls and a half.
    std::vector<double> ends_deg;
    for (const ScanSegment& s : segments) ends_deg.push_back(degrees(scan.angle_rad(s.first + s.count - 1)));
    for (const double corner_deg : {-36.87, 36.87})
      EXPECT_THAT(ends_deg, testing::Contains(testing::DoubleNear(corner_deg, 1.0)));
  }
  const Scan jump =
      scan_of({.beams = 200, .first_deg = 0.0}, [](int i, double) { return i < 100 ? 2.0 : 2.2; });
  const auto parts = segment_by_kalman(jump);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[1].first, 100U);
}

TEST(SegmentByKalman, TurningTheSensorTurnsTheSegments) {
  Rng rng(3);
  const RayCaster walls(test::niche_room().segments());
  const Scan scan = test::seen(walls, {3, 2, 0.3}, 0.01, rng, kFullCircle);
  for (const std::size_t by : {1U, 400U, 1439U}) {
    auto expected = segment_by_kalman(scan);
    for (ScanSegment& segment : expected) segment.first = (segment.first + scan.size() - by) % scan.size();
    EXPECT_THAT(segment_by_kalman(test::turned(scan, by)), testing::UnorderedElementsAreArray(expected));
  }
}

TEST(SegmentByKalman, HitsAreInSegmentsAndOnlyHits) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  const Scan scan = test::with_holes(test::seen(walls, {3, 2, 0.3}, 0.01, rng, kFullCircle), 0.3, rng);
  std::vector<int> owners(scan.size(), 0);
  for (const ScanSegment& segment : segment_by_kalman(scan))
    for (std::size_t k = 0; k < segment.count; ++k) ++owners[segment.beam(k, scan.size())];
  for (std::size_t i = 0; i < scan.size(); ++i) EXPECT_EQ(owners[i], scan.is_hit(i) ? 1 : 0);
  EXPECT_TRUE(segment_by_kalman(scan_of({.beams = 2}, [](int, double) { return 0.0; })).empty());
}

}  // namespace
}  // namespace beaconless
