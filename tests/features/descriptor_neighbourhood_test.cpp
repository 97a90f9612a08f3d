// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/descriptor_neighbourhood.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/features/descriptor_distance.hpp"
#include "beaconless/geometry/angle.hpp"

namespace beaconless {
namespace {

Scan some_scan(double first_rad, double step_rad, std::size_t size) {
  RawScan raw{.angle_min_rad = static_cast<float>(first_rad),
              .angle_increment_rad = static_cast<float>(step_rad),
              .range_max_m = 30.0F};
  raw.ranges_m.assign(size, 5.0F);
  return Scan::make(raw).value();
}

TEST(BeamsAround, AreThoseThatPassWithinTheRadius) {
  Rng rng(1);
  for (int run = 0; run < 400; ++run) {
    const auto size = static_cast<std::size_t>(rng.uniform(1.0, 720.0));
    const bool circle = run % 3 == 0;
    const Scan scan =
        some_scan(rng.uniform(-6.0, 6.0),
                  2.0 * kPi / static_cast<double>(size) * (circle ? 1.0 : rng.uniform(0.3, 0.99)), size);
    const double range_m = rng.uniform(0.1, 10.0);
    const double bearing = rng.uniform(-kPi, kPi);
    const Eigen::Vector2d point(range_m * std::cos(bearing), range_m * std::sin(bearing));
    const double radius_m = rng.uniform(0.01, 3.0);
    const BeamWindow window = beams_around(scan, point, radius_m);
    std::vector<int> times(scan.size(), 0);
    for (const ScanSegment& run_of_beams : window.runs)
      for (std::size_t k = 0; k < run_of_beams.count; ++k) ++times[run_of_beams.first + k];
    ASSERT_LE(window.count(), scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const double off = std::abs(wrap_angle(scan.angle_rad(i) - bearing));
      const double passes_m = off < kPi / 2 ? range_m * std::sin(off) : range_m;
      if (std::abs(passes_m - radius_m) < 1e-4) continue;
      if (radius_m < range_m && off < kPi / 2)
        ASSERT_EQ(times[i], passes_m < radius_m ? 1 : 0) << i << " of " << scan;
      else if (radius_m >= range_m)
        ASSERT_EQ(times[i], 1);
      else
        ASSERT_EQ(times[i], 0);
    }
  }
}

TEST(BeamsAround, OfWhatIsNoPlaceAreNone) {
  const Scan scan = some_scan(-1.0, 0.01, 200);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(beams_around(scan, {nan, 1.0}, 0.5).count(), 0U);
  EXPECT_EQ(beams_around(scan, {std::numeric_limits<double>::infinity(), 1.0}, 0.5).count(), 0U);
  EXPECT_EQ(beams_around(scan, {1.0, 1.0}, 0.0).count(), 0U);
  EXPECT_EQ(beams_around(scan, {1.0, 1.0}, nan).count(), 0U);
  EXPECT_EQ(beams_around(scan, {-5.0, 0.0}, 0.5).count(), 0U);  // behind the sensor
  EXPECT_EQ(beams_around(scan, {0.0, 0.0}, 0.5).count(), 200U);
}

TEST(Neighbourhood, RadiusIsMetricUnlessItGrows) {
  EXPECT_EQ((NeighbourhoodConfig{0.5, 0.0}.radius_at(20.0)), 0.5);
  EXPECT_NEAR((NeighbourhoodConfig{0.1, 0.07}.radius_at(10.0)), 0.1 * std::exp(0.7), 1e-12);
}

TEST(SymmetricChiSquare, IsZeroForEqualAndOneForDisjointHistograms) {
  const std::array<float, 4> a{0.5F, 0.5F, 0.0F, 0.0F};
  const std::array<float, 4> b{0.0F, 0.0F, 0.25F, 0.75F};
  const std::array<float, 4> c{0.25F, 0.75F, 0.0F, 0.0F};
  EXPECT_EQ(symmetric_chi_square(a, a), 0.0);
  EXPECT_NEAR(symmetric_chi_square(a, b), 1.0, 1e-6);
  EXPECT_NEAR(symmetric_chi_square(a, c), 0.5 * (0.0625 / 0.75 + 0.0625 / 1.25), 1e-6);
  EXPECT_EQ(symmetric_chi_square(a, c), symmetric_chi_square(c, a));
}

}  // namespace
}  // namespace beaconless
