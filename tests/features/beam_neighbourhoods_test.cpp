// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/beam_neighbourhoods.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/full_circle.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

const KeypointRadius kRadius{.at_zero_m = 0.2, .growth_per_m = 0.07};

/// The definition, beam by beam: walk away from the beam through hits; the last one within the radius counts.
std::size_t farthest_twin(const Scan& scan, std::size_t beam, bool forward) {
  const double radius = static_cast<double>(kRadius.at(scan.ranges_m()[beam]));
  std::size_t far = 0;
  const std::size_t most = scan.is_full_circle() ? scan.size() / 2 : scan.size();
  for (std::size_t k = 1; k < most; ++k) {
    const auto at = static_cast<std::ptrdiff_t>(beam) + (forward ? 1 : -1) * static_cast<std::ptrdiff_t>(k);
    const auto size = static_cast<std::ptrdiff_t>(scan.size());
    if (!scan.is_full_circle() && (at < 0 || at >= size)) break;
    const auto other = static_cast<std::size_t>((at + size) % size);
    if (!scan.is_hit(other)) break;
    if ((scan.point(other) - scan.point(beam)).norm() <= radius) far = k;
  }
  return far;
}

void expect_as_defined(const Scan& scan) {
  BeamNeighbourhoods around;
  around.assign(scan, kRadius);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!scan.is_hit(beam)) continue;
    const std::size_t place = around.points.begin() + beam;
    ASSERT_EQ(place - around.first[place], farthest_twin(scan, beam, false)) << beam;
    ASSERT_EQ(around.last[place] - place, farthest_twin(scan, beam, true)) << beam;
  }
}

RawScan with_gaps(RawScan raw, Rng& rng) {
  for (float& range : raw.ranges_m)
    if (rng.uniform() < 0.3) range = 0.0F;
  return raw;
}

TEST(BeamNeighbourhoods, AreThoseOfTheDefinition) {
  Rng rng(5);
  const RayCaster walls(test::niche_room().segments());
  for (const Pose2& pose : {Pose2{3, 2, 0}, Pose2{0.3, 0.4, 2.0}, Pose2{6.9, 2.5, -1.0}}) {
    const RawScan sector = test::sweep(walls, pose, 0.01, rng);
    const RawScan circle = test::full_circle(walls, pose, 0.01, rng, 721);
    for (const RawScan& raw : {sector, circle, with_gaps(sector, rng), with_gaps(circle, rng)})
      expect_as_defined(Scan::make(raw).value());
  }
}

TEST(BeamNeighbourhoods, OfFewBeamsAreNotBeyondThem) {
  for (std::size_t beams : {1U, 2U, 3U, 5U, 7U}) {
    for (double step_deg : {0.25, 360.0 / static_cast<double>(std::max<std::size_t>(beams, 2))}) {
      RawScan raw{.angle_increment_rad = static_cast<float>(radians(step_deg)),
                  .range_min_m = 0.0F,
                  .range_max_m = 10.0F};
      raw.ranges_m.assign(beams, 2.0F);
      expect_as_defined(Scan::make(raw).value());
    }
  }
}

TEST(BeamNeighbourhoods, OfBeamsFinerThanAnyAreWithinTheScan) {
  RawScan raw{.angle_increment_rad = 1e-6F, .range_min_m = 0.0F, .range_max_m = 10.0F};
  raw.ranges_m.assign(3000, 2.0F);
  expect_as_defined(Scan::make(raw).value());
}

TEST(Exp4, IsTheExponential) {
  for (float x = 0.0F; x <= 80.0F; x += 0.0137F) {
    const double exact = std::exp(static_cast<double>(x));
    EXPECT_NEAR(static_cast<double>(exp4(Floats4{} + x)[3]) / exact, 1.0, 5e-6) << x;
  }
}

TEST(KeypointRadius, NeverReachesTheScanner) {
  for (const float range : {0.01F, 0.1F, 0.2F, 0.5F, 3.0F, 30.0F}) EXPECT_LT(kRadius.at(range), range);
  EXPECT_NEAR(kRadius.at(10.0F), 0.2 * std::exp(0.7), 1e-6);
}

TEST(BeamsWithin, LeavesOutNobody) {
  for (double sine = 0.001; sine < 0.8; sine += 0.001)
    EXPECT_GE(static_cast<double>(beams_within(static_cast<float>(sine), 1.0F, 1000.0F)),
              1000.0 * std::asin(sine));
}

}  // namespace
}  // namespace beaconless
