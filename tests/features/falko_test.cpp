// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/falko.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/allocations.hpp"
#include "tests/support/full_circle.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Points = std::vector<Eigen::Vector2d>;

const Points kSquareCorners = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};

FalkoConfig authors() { return falko_preset("authors").value(); }

/// The raw scores by the definition (ALGORITHMS of the paper, steps 1 to 6): atan2, all pairs, doubles.
std::vector<int> raw_twin(const Scan& scan, const FalkoConfig& config) {
  std::vector<int> raw(scan.size(), FalkoScratch::kUntested);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!scan.is_hit(i)) continue;
    const double radius = static_cast<double>(config.radius.at(scan.ranges_m()[i]));
    Points sides[2];
    for (const int step : {-1, 1})
      for (auto j = static_cast<std::ptrdiff_t>(i) + step;
           j >= 0 && j < static_cast<std::ptrdiff_t>(scan.size()) && scan.is_hit(static_cast<std::size_t>(j));
           j += step) {
        const Eigen::Vector2d away = scan.point(static_cast<std::size_t>(j)) - scan.point(i);
        if (away.norm() <= radius) sides[step < 0 ? 0 : 1].push_back(away);
      }
    const auto least = static_cast<std::size_t>(config.min_points);
    if (sides[0].size() < least || sides[1].size() < least) continue;
    const Eigen::Vector2d base = sides[1].back() - sides[0].back();
    const double height =
        std::abs(base.x() * sides[0].back().y() - base.y() * sides[0].back().x()) / base.norm();
    if (base.norm() < radius / config.base_ratio || height < radius / config.base_ratio) continue;
    Eigen::Vector2d bisector = Eigen::Vector2d::Zero();
    for (const Points& side : sides)
      for (const Eigen::Vector2d& away : side) bisector += away / static_cast<double>(side.size());
    const double width = 2.0 * kPi / config.sectors;
    const double zero = std::atan2(bisector.y(), bisector.x()) - (config.centred_sectors ? 0.5 * width : 0.0);
    int sum = 0;
    for (const Points& side : sides) {
      std::vector<int> sectors;
      for (const Eigen::Vector2d& away : side) {
        const double angle = std::atan2(away.y(), away.x()) - zero;
        sectors.push_back(static_cast<int>((angle - 2.0 * kPi * std::floor(angle / (2.0 * kPi))) / width));
      }
      for (std::size_t a = 0; a < sectors.size(); ++a)
        for (std::size_t b = a + 1; b < sectors.size(); ++b) {
          const int apart = std::abs(sectors[a] - sectors[b]);
          sum += std::min(apart, config.sectors - apart);
        }
    }
    raw[i] = sum;
  }
  return raw;
}

TEST(Falko, RawScoresAreThoseOfTheDefinition) {
  Rng rng(2);
  const RayCaster walls(test::niche_room().segments());
  for (const bool centred : {false, true}) {
    FalkoConfig config = authors();
    config.centred_sectors = centred;
    int tested = 0;
    int different = 0;
    for (int k = 0; k < 20; ++k) {
      const Scan scan = Scan::make(test::sweep(walls, {1.0 + 0.2 * k, 1.5, 0.3 * k}, 0.01, rng)).value();
      FalkoScratch scratch;
      std::vector<Keypoint> keypoints;
      detect_falko(scan, config, scratch, keypoints);
      const std::vector<int> twin = raw_twin(scan, config);
      for (std::size_t i = 0; i < scan.size(); ++i) {
        tested += twin[i] != FalkoScratch::kUntested ? 1 : 0;
        different += twin[i] != scratch.raw[i] ? 1 : 0;
      }
    }
    ASSERT_GT(tested, 300);
    // a neighbour on the very limit of a sector or of the radius falls either way in float
    EXPECT_LE(different, tested / 100) << "of " << tested;
  }
}

/// A square room seen whole from its middle without noise: all four corners have the same score.
TEST(Falko, FindsExactlyTheFourCornersOfASquareFromItsMiddle) {
  Rng rng(1);
  const RayCaster walls(test::rectangle(4, 4).segments());
  for (const double heading_deg : {0.0, 45.0, 10.0, 77.0}) {
    const Pose2 pose{2, 2, radians(heading_deg)};
    const Scan scan = Scan::make(test::full_circle(walls, pose, 0.0, rng)).value();
    for (const FalkoConfig& config : {FalkoConfig{}, authors()}) {
      const auto keypoints = detect_falko(scan, config);
      ASSERT_EQ(keypoints.size(), 4U) << heading_deg;
      for (const Keypoint& keypoint : keypoints) {
        const Eigen::Vector2d at = pose * keypoint.point;
        const Eigen::Vector2d corner((at.x() > 2 ? 4 : 0), (at.y() > 2 ? 4 : 0));
        EXPECT_LT((at - corner).norm(), 1e-3 + (config.subbeam == SubBeam::arms ? 0.0 : 0.01));
        const Eigen::Vector2d inwards = Eigen::Vector2d(2, 2) - corner;
        EXPECT_NEAR(
            wrap_angle(keypoint.orientation_rad + pose.theta_rad - std::atan2(inwards.y(), inwards.x())), 0.0,
            0.05)
            << "the bisector points into the room";
      }
    }
  }
}

TEST(Falko, RawScoresDoNotDependOnTheHeading) {
  // the same noisy points in the frame of a turned sensor: only the array shifts
  Rng rng(3);
  const RayCaster walls(test::rectangle(4, 4).segments());
  const RawScan first = test::full_circle(walls, {2.3, 1.8, 0}, 0.003, rng);
  FalkoScratch scratch;
  std::vector<Keypoint> keypoints;
  detect_falko(Scan::make(first).value(), {}, scratch, keypoints);
  const std::vector<int> at_zero = scratch.raw;
  const std::size_t count = keypoints.size();
  ASSERT_EQ(count, 4U);
  for (int heading_deg = 1; heading_deg < 360; ++heading_deg) {
    RawScan turned = first;
    std::rotate(turned.ranges_m.begin(), turned.ranges_m.begin() + 4 * heading_deg, turned.ranges_m.end());
    detect_falko(Scan::make(turned).value(), {}, scratch, keypoints);
    ASSERT_EQ(keypoints.size(), count) << heading_deg;
    int total = 0;
    int off = 0;
    for (std::size_t i = 0; i < at_zero.size(); ++i) {
      const int now = scratch.raw[(i + 1440 - static_cast<std::size_t>(4 * heading_deg)) % 1440];
      ASSERT_EQ(now == FalkoScratch::kUntested, at_zero[i] == FalkoScratch::kUntested) << heading_deg;
      total += std::max(0, at_zero[i]);
      off += std::abs(now - at_zero[i]);
    }
    EXPECT_LE(off, total / 20) << "more than 5 % at " << heading_deg << " degrees";
  }
}

/// How many of the square's corners that the scan sees with both arms are found within 10 cm, and all of
/// them.
struct Tally {
  int scans = 0;
  int complete = 0;
};

Tally corners_found(double sigma_m, const FalkoConfig& config) {
  Rng rng(11);
  const RayCaster walls(test::rectangle(4, 4).segments());
  Tally tally;
  for (int heading_deg = 0; heading_deg < 360; ++heading_deg) {
    const Pose2 pose{2.2, 1.7, radians(heading_deg)};
    const auto keypoints = detect_falko(Scan::make(test::sweep(walls, pose, sigma_m, rng)).value(), config);
    int visible = 0;
    int found = 0;
    for (const Eigen::Vector2d& corner : kSquareCorners) {
      const Eigen::Vector2d seen = pose.inverse() * corner;
      const double arm_rad = 0.35 / seen.norm();
      if (std::abs(std::atan2(seen.y(), seen.x())) > radians(135.0) - arm_rad) continue;
      ++visible;
      found +=
          std::ranges::any_of(keypoints, [&](const Keypoint& k) { return (k.point - seen).norm() < 0.1; });
    }
    ++tally.scans;
    tally.complete += found == visible && visible >= 2 ? 1 : 0;
  }
  return tally;
}

TEST(Falko, FindsAllVisibleCornersOfASquareAtEveryHeading) {
  for (const double sigma : {0.003, 0.01}) {
    const Tally ours = corners_found(sigma, {});
    EXPECT_GE(ours.complete * 100, ours.scans * 99) << "sigma " << sigma;
  }
}

TEST(Falko, PutsTheKeypointBetweenTheBeams) {
  Rng rng(7);
  const RayCaster walls(test::rectangle(4, 4).segments());
  double at_beam = 0.0;
  double refined = 0.0;
  FalkoConfig beams_only;
  beams_only.subbeam = SubBeam::off;
  FalkoConfig neighbourhood;
  neighbourhood.subbeam = SubBeam::neighbourhood;
  double as_authors = 0.0;
  int count = 0;
  for (int k = 0; k < 100; ++k) {
    const Pose2 pose{2.0 + 0.003 * k, 1.7, 0.8};
    const Scan scan = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
    const auto error = [&](const Keypoint& keypoint) {
      double least = 1.0;
      for (const Eigen::Vector2d& corner : kSquareCorners)
        least = std::min(least, (pose * keypoint.point - corner).norm());
      return least;
    };
    for (const Keypoint& keypoint : detect_falko(scan, beams_only)) at_beam += error(keypoint);
    for (const Keypoint& keypoint : detect_falko(scan, neighbourhood)) as_authors += error(keypoint);
    for (const Keypoint& keypoint : detect_falko(scan)) refined += error(keypoint), ++count;
  }
  ASSERT_GT(count, 150);
  EXPECT_LT(refined / count, 0.006);
  EXPECT_LT(refined, 0.4 * at_beam);
  EXPECT_LT(refined, 0.8 * as_authors) << "grown sides know more than the neighbourhood";
}

/// The same room seen in a mirror: the same keypoints, mirrored.
TEST(Falko, SeesNoDifferenceInAMirror) {
  Rng rng(12);
  const RayCaster walls(test::niche_room().segments());
  std::size_t all = 0;
  std::size_t compared = 0;
  for (int k = 0; k < 20; ++k) {
    RawScan raw = test::sweep(walls, {1.0 + 0.2 * k, 1.5, 0.3 * k}, 0.01, rng);
    FalkoConfig config;
    config.subbeam = SubBeam::off;
    const auto seen = detect_falko(Scan::make(raw).value(), config);
    std::ranges::reverse(raw.ranges_m);
    const auto mirrored = detect_falko(Scan::make(raw).value(), config);
    ASSERT_EQ(mirrored.size(), seen.size());
    all += seen.size();
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Keypoint& other = mirrored[seen.size() - 1 - i];
      if (std::abs(static_cast<int>(1080 - other.beam) - static_cast<int>(seen[i].beam)) > 0)
        continue;  // a tie
      ++compared;
      EXPECT_NEAR(wrap_angle(seen[i].orientation_rad + other.orientation_rad), 0.0, 1e-4);
      EXPECT_NEAR(seen[i].score, other.score, 0.05) << "float rounding at the limits of sectors";
    }
  }
  EXPECT_GE(compared * 10, all * 9) << "ties are rare";
}

TEST(Falko, LooksOnlyWhereItIsTold) {
  Rng rng(12);
  const RayCaster walls(test::rectangle(4, 4).segments());
  const Scan scan = Scan::make(test::full_circle(walls, {1, 1, 0.3}, 0.005, rng)).value();
  FalkoConfig far;
  far.range_min_m = 2.0;
  FalkoConfig near;
  near.range_max_m = 2.0;
  ASSERT_EQ(detect_falko(scan).size(), 4U);
  EXPECT_EQ(detect_falko(scan, far).size(), 3U) << "one corner is 1.4 m away";
  EXPECT_EQ(detect_falko(scan, near).size(), 1U);
  FalkoConfig bound;
  bound.subbeam_limit_m = 0.0;
  for (const Keypoint& keypoint : detect_falko(scan, bound))
    EXPECT_EQ(keypoint.point, scan.point(keypoint.beam)) << "no refinement is believed";
}

TEST(Falko, IsNothingWhereThereIsNoCorner) {
  const auto flat = [](auto range_of) {
    RawScan raw{
        .angle_min_rad = -1.0F, .angle_increment_rad = 0.005F, .range_min_m = 0.1F, .range_max_m = 30.0F};
    for (int i = 0; i < 400; ++i) raw.ranges_m.push_back(range_of(-1.0 + 0.005 * i));
    return Scan::make(raw).value();
  };
  EXPECT_TRUE(
      detect_falko(flat([](double angle) { return static_cast<float>(2.0 / std::cos(angle)); })).empty())
      << "a straight wall";
  EXPECT_TRUE(detect_falko(flat([](double) { return 5.0F; })).empty()) << "a round room";
  EXPECT_TRUE(detect_falko(flat([](double) { return 0.0F; })).empty()) << "nothing seen";
  EXPECT_TRUE(detect_falko(flat([](double angle) { return angle < 0.0 ? 2.0F : 6.0F; })).empty())
      << "something in front of something";
}

TEST(Falko, SurvivesAnything) {
  Rng rng(17);
  for (int k = 0; k < 300; ++k) {
    RawScan raw{.angle_min_rad = -3.0F,
                .angle_increment_rad = static_cast<float>(rng.uniform(0.002, 0.1)),
                .range_min_m = 0.0F,
                .range_max_m = 40.0F};
    const int beams = 1 + static_cast<int>(rng.uniform(0.0, 700.0));
    for (int i = 0; i < beams; ++i)
      raw.ranges_m.push_back(rng.uniform() < 0.3 ? std::numeric_limits<float>::quiet_NaN()
                                                 : static_cast<float>(rng.uniform(0.0, 3.0)));
    const Scan scan = Scan::make(raw).value();
    for (const char* preset : {"beaconless", "authors", "dissertation"})
      for (const Keypoint& keypoint : detect_falko(scan, falko_preset(preset).value())) {
        ASSERT_TRUE(keypoint.point.allFinite());
        ASSERT_TRUE(std::isfinite(keypoint.orientation_rad));
        ASSERT_TRUE(keypoint.score >= 0.0 && keypoint.score <= 1.0);
        ASSERT_LT(keypoint.beam, scan.size());
      }
  }
}

TEST(Falko, AllocatesNothingOnceItHasSeenAScan) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  std::vector<Scan> scans;
  for (int i = 0; i < 10; ++i)
    scans.push_back(Scan::make(test::sweep(walls, {3.0 + 0.05 * i, 2, 0.1 * i}, 0.01, rng)).value());
  FalkoScratch scratch;
  std::vector<Keypoint> keypoints;
  for (const Scan& scan : scans) detect_falko(scan, {}, scratch, keypoints);
  const std::size_t before = test::allocations();
  for (const Scan& scan : scans) detect_falko(scan, {}, scratch, keypoints);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_FALSE(keypoints.empty());
}

TEST(FalkoPreset, IsKnownByName) {
  EXPECT_DOUBLE_EQ(falko_preset("dissertation").value().base_ratio, 5.5);
  EXPECT_DOUBLE_EQ(falko_preset("dissertation").value().nms_radius_m, 0.03);
  EXPECT_DOUBLE_EQ(falko_preset("authors").value().radius.at_zero_m, 0.1);
  EXPECT_FALSE(falko_preset("autors"));
  for (const char* name : {"beaconless", "authors", "dissertation"})
    EXPECT_TRUE(check_config(falko_preset(name).value())) << name;
}

TEST(AngleSectors, AreThoseOfAtan2) {
  Rng rng(8);
  for (const int count : {4, 8, 16, 32, 64}) {
    AngleSectors sectors;
    sectors.assign(count);
    for (int k = 0; k < 1000; ++k) {
      const double angle = rng.uniform(0.0, 2.0 * kPi);
      const float x = static_cast<float>(std::cos(angle));
      const float y = static_cast<float>(std::sin(angle));
      const Floats4 found = sectors.of(Floats4{x, x, x, x}, Floats4{y, y, y, y});
      EXPECT_EQ(static_cast<int>(found[2]), static_cast<int>(angle / (2.0 * kPi) * count))
          << angle << " of " << count;
    }
  }
}

}  // namespace
}  // namespace beaconless
