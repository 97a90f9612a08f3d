// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/lines.hpp"

#include <gmock/gmock.h>

#include "tests/features/made_scans.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using test::kFullCircle;
using test::seen;

double off_wall_m(const RayCaster& walls, const Eigen::Vector2d& point) {
  double least = 1e9;
  for (const Segment2& wall : walls.segments()) least = std::min(least, wall.distance_m(point));
  return least;
}

TEST(Merge, JoinsWhatOneLineExplainsAndNothingElse) {
  Rng rng(1);
  const Scan bent = test::scan_of({.beams = 200, .first_deg = -25.0}, [&](int, double bearing) {
    const double turned = bearing < 0.0 ? bearing : bearing - radians(20.0);
    const double rho = bearing < 0.0 ? 2.0 : 2.0 * std::cos(radians(20.0));
    return rho / std::cos(turned) + rng.normal(0.01);
  });
  const std::vector<ScanSegment> pieces = {{0, 21}, {20, 41}, {60, 41}, {102, 49}, {150, 50}};
  const auto merged = merge(bent, pieces);
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0], (ScanSegment{0, 101}));
  EXPECT_EQ(merged[1], (ScanSegment{102, 98}));
  EXPECT_EQ(merge(bent, merged), merged);
  EXPECT_TRUE(merge(bent, {}).empty());
}

TEST(Merge, BridgesAFewBeamsAndNoMore) {
  const Scan wall = test::scan_of({.beams = 100, .first_deg = -12.5},
                                  [&](int, double bearing) { return 2.0 / std::cos(bearing); });
  EXPECT_EQ(merge(wall, std::vector<ScanSegment>{{0, 40}, {43, 50}}).size(), 1U);
  EXPECT_EQ(merge(wall, std::vector<ScanSegment>{{0, 40}, {44, 50}}).size(), 2U);
}

TEST(Merge, RunsOverTheEndOfAFullCircle) {
  const Scan wall = test::scan_of(kFullCircle, [&](int, double bearing) {
    const double from = std::abs(bearing) > radians(160) ? std::cos(kPi - std::abs(bearing)) : 0.0;
    return from > 0.0 ? 2.0 / from : 0.0;
  });
  const auto pieces = split(wall, segment_by_distance(wall));
  ASSERT_EQ(pieces.size(), 1U);
  const std::vector<ScanSegment> two = {{0, 79}, {1361, 78}};
  const auto merged = merge(wall, two);
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_EQ(merged[0], (ScanSegment{1361, 158}));
}

/// Weights grow with the square of the range, terms with its fourth power: in one sum a single beam that saw
/// a mountain would leave nothing of the room.
TEST(FindLines, OneVeryFarBeamHarmsNoOther) {
  Rng rng(6);
  const RayCaster walls(test::niche_room().segments());
  for (const float far_m : {100.0F, 3000.0F, 30000.0F}) {
    RawScan raw = test::sweep(walls, {3, 2, 0.2}, 0.01, rng);
    raw.range_max_m = 0.0F;
    raw.ranges_m[100] = 12.0F;  // through a gap into the next room
    const auto without = find_lines(Scan::make(raw).value());
    raw.ranges_m[100] = far_m;
    const auto with = find_lines(Scan::make(raw).value());
    ASSERT_EQ(with.size(), without.size()) << far_m;
    for (std::size_t i = 0; i < with.size(); ++i) {
      EXPECT_NEAR(with[i].fit.line.rho_m, without[i].fit.line.rho_m, 1e-6) << far_m;
      EXPECT_NEAR(with[i].fit.line.alpha_rad, without[i].fit.line.alpha_rad, 1e-6) << far_m;
    }
  }
}

TEST(LineSums, ChiSquareIsThatOfTheLinesOwnBeams) {
  Rng rng(2);
  const Scan wall = test::scan_of({.beams = 161, .first_deg = 10.0}, [&](int, double bearing) {
    return 2.0 / std::cos(bearing) + rng.normal(0.01);
  });
  OrderedPointsScratch buffers;
  LineSums sums;
  const OrderedPoints points = ordered_points(wall, {}, buffers);
  sums.build(points, 0.01, BeamWeight::radial);
  const PointMoments moments = sums.of(20, 120);
  const PrincipalLine line = principal_line(moments);
  double slow = 0.0;
  for (std::size_t i = 20; i <= 120; ++i) {
    const double weight = points[i].squaredNorm();
    slow += weight * std::pow(line.signed_distance_m(points[i]), 2);
  }
  slow /= std::pow(sums.unit_sigma_m(line, moments), 2);
  EXPECT_NEAR(sums.chi_square(moments), slow, 1e-6);
  EXPECT_NEAR(sums.chi_square(moments) / 99.0, 1.0, 0.5);
}

// Radial weights are the best there are: over many scans of a wall seen flatly the line is nearer to the
// truth with them, and as near as its covariance says.
TEST(FindLines, RadialWeightsPayAndTheirCovarianceIsHonest) {
  Rng rng(3);
  double uniform = 0.0;
  double radial = 0.0;
  double nees = 0.0;
  const int runs = 1500;
  for (int run = 0; run < runs; ++run) {
    const Scan wall = test::scan_of({.beams = 281, .first_deg = 5.0}, [&](int, double bearing) {
      return 2.0 / std::cos(bearing) + rng.normal(0.01);
    });
    for (const BeamWeight weight : {BeamWeight::uniform, BeamWeight::radial}) {
      const auto lines = find_lines(wall, {.weight = weight});
      ASSERT_EQ(lines.size(), 1U);
      const Eigen::Vector2d error(lines[0].fit.line.alpha_rad, lines[0].fit.line.rho_m - 2.0);
      (weight == BeamWeight::uniform ? uniform : radial) += error.x() * error.x() / runs;
      if (weight == BeamWeight::radial) {
        const Eigen::Matrix2d P = lines[0].fit.covariance;
        const double determinant = P(0, 0) * P(1, 1) - P(0, 1) * P(0, 1);
        nees += (P(1, 1) * error.x() * error.x() - 2 * P(0, 1) * error.x() * error.y() +
                 P(0, 0) * error.y() * error.y()) /
                determinant / runs;
      }
    }
  }
  EXPECT_LT(radial, 0.8 * uniform);
  EXPECT_NEAR(nees, 2.0, 2.58 * std::sqrt(4.0 / runs) + 0.1);
}

TEST(FindLines, AreTheWallsOfARoom) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  for (int run = 0; run < 30; ++run) {
    const Pose2 pose{rng.uniform(0.6, 5.4), rng.uniform(0.6, 3.0), rng.uniform(-kPi, kPi)};
    std::vector<int> owners(1440, 0);
    const Scan scan = seen(walls, pose, 0.01, rng, kFullCircle);
    int in_lines = 0;
    for (const ScanLine& line : find_lines(scan)) {
      EXPECT_LT(off_wall_m(walls, pose * line.a), 0.03);
      EXPECT_LT(off_wall_m(walls, pose * line.b), 0.03);
      EXPECT_LT(off_wall_m(walls, pose * Eigen::Vector2d(0.5 * (line.a + line.b))), 0.03);
      for (std::size_t k = 0; k < line.beams.count; ++k) ++owners[line.beams.beam(k, 1440)];
      in_lines += static_cast<int>(line.beams.count);
    }
    EXPECT_GT(in_lines, 1400);
    for (const int owner : owners) EXPECT_LE(owner, 1);
  }
}

TEST(FindLines, EveryMethodFindsTheSameWalls) {
  Rng rng(5);
  const RayCaster walls(test::rectangle(4, 3).segments());
  const Scan scan = seen(walls, {1.7, 1.3, 0.4}, 0.005, rng, kFullCircle);
  const auto expected = find_lines(scan, {.sigma_m = 0.005});
  ASSERT_EQ(expected.size(), 4U);
  for (const LineFitMethod method :
       {LineFitMethod::regression, LineFitMethod::ransac, LineFitMethod::theil_sen}) {
    const auto lines = find_lines(scan, {.sigma_m = 0.005, .fit = {.method = method}});
    ASSERT_EQ(lines.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(lines[i].beams, expected[i].beams);
      EXPECT_NEAR(wrap_angle(lines[i].fit.line.alpha_rad - expected[i].fit.line.alpha_rad), 0.0, 0.005);
      EXPECT_NEAR(lines[i].fit.line.rho_m, expected[i].fit.line.rho_m, 0.005);
    }
  }
}

TEST(FindLines, WithOrWithoutSegmentationFirst) {
  Rng rng(6);
  const RayCaster walls(test::rectangle(4, 3).segments());
  const Scan scan = seen(walls, {1.7, 1.3, 0.4}, 0.01, rng);
  EXPECT_EQ(find_lines(scan).size(), find_lines(scan, {.is_segmented_first = false}).size());
}

TEST(FindLines, AJogOfTenCentimetresIsTwoWalls) {
  Rng rng(7);
  const RayCaster walls({{{0, -2}, {0, 0}}, {{0, 0}, {0.1, 0}}, {{0.1, 0}, {0.1, 2}}});
  int two = 0;
  for (int run = 0; run < 200; ++run) {
    const auto lines = find_lines(seen(walls, {-2, 0.05, 0}, 0.01, rng));
    if (lines.size() != 2) continue;
    ++two;
    EXPECT_NEAR(lines[1].fit.line.rho_m - lines[0].fit.line.rho_m, 0.1, 0.01);
  }
  EXPECT_GE(two, 197);
}

// A cut needs a chi-square of two degrees of freedom beyond 18 at the best of some places.
TEST(FindLines, NoiseCutsAWallOnceInAThousandScans) {
  Rng rng(17);
  int cut = 0;
  for (int run = 0; run < 2000; ++run) {
    const double normal = rng.uniform(-0.3, 0.3);
    const Scan wall = test::scan_of({.beams = 120, .first_deg = -15.0}, [&](int, double bearing) {
      return 2.0 / std::cos(bearing - normal) + rng.normal(0.01);
    });
    cut += find_lines(wall).size() == 1 ? 0 : 1;
  }
  EXPECT_LE(cut, 6);
}

TEST(FindLines, HolesDegradeSmoothly) {
  Rng rng(8);
  const RayCaster walls(test::niche_room().segments());
  for (int run = 0; run < 50; ++run) {
    const Scan whole = seen(walls, {2.8, 1.8, rng.uniform(-3, 3)}, 0.01, rng, kFullCircle);
    const auto lines = find_lines(test::with_holes(whole, 0.3, rng));
    EXPECT_GE(lines.size(), 6U);
    for (const ScanLine& line : lines) {
      EXPECT_TRUE(line.fit.covariance.allFinite());
      EXPECT_TRUE(whole.is_hit(line.beams.first));
    }
  }
}

TEST(FindLines, NothingInScansThatHoldNothing) {
  for (const int beams : {1, 2, 3, 1081})
    for (const double range : {0.0, 1.0, 1e-2}) {
      const auto lines = find_lines(test::scan_of({.beams = beams}, [&](int, double) { return range; }));
      EXPECT_TRUE(lines.empty() || (beams >= 4 && range > 0.0));
      for (const ScanLine& line : lines) EXPECT_TRUE(line.fit.covariance.allFinite());
    }
}

TEST(FindLines, AllocatesNothingPerScan) {
  Rng rng(9);
  const RayCaster walls(test::niche_room().segments());
  for (const test::Fan& fan : {test::Fan{}, kFullCircle})
    for (const LineFitMethod method : {LineFitMethod::tls, LineFitMethod::ransac, LineFitMethod::theil_sen}) {
      const LinesConfig config{.fit = {.method = method}};
      const Scan scan = seen(walls, {2.8, 1.8, 0.5}, 0.01, rng, fan);
      LinesScratch scratch;
      std::vector<ScanLine> lines;
      find_lines(scan, config, scratch, lines);
      const std::size_t before = test::allocations();
      find_lines(scan, config, scratch, lines);
      EXPECT_EQ(test::allocations(), before);
    }
}

}  // namespace
}  // namespace beaconless
