// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/oc.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "beaconless/features/dominant_direction.hpp"

#include "tests/support/allocations.hpp"
#include "tests/support/full_circle.hpp"
#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kQuarter = 0.5 * kPi;

/// The orthogonal spectrum of the public library, whole: a Hough transform over half a turn.
double dominant_twin(const Scan& scan) {
  constexpr int kAngles = 360;
  constexpr double kRhoStep_m = 0.02;
  std::vector<double> spectrum(kAngles, 0.0);
  for (int a = 0; a < kAngles; ++a) {
    const double theta = kPi * a / kAngles;
    std::vector<int> votes(4000, 0);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (!scan.is_hit(i)) continue;
      const Eigen::Vector2d p = scan.point(i);
      const double rho = p.x() * std::cos(theta) + p.y() * std::sin(theta);
      ++votes[static_cast<std::size_t>(2000 + std::lround(rho / kRhoStep_m))];
    }
    for (const int v : votes) spectrum[static_cast<std::size_t>(a)] += static_cast<double>(v) * v;
  }
  int best = 0;
  const auto both = [&](int a) {
    return spectrum[static_cast<std::size_t>(a)] + spectrum[static_cast<std::size_t>(a + kAngles / 2)];
  };
  for (int a = 1; a < kAngles / 2; ++a)
    if (both(a) > both(best)) best = a;
  return kPi * best / kAngles;
}

double direction_of(const Scan& scan) {
  BeamNeighbourhoods around;
  around.assign(scan, OcConfig{}.radius);
  return dominant_direction(around);
}

/// The difference of two directions that mean the same a quarter turn apart.
double apart(double a, double b) { return std::abs(std::remainder(a - b, kQuarter)); }

TEST(DominantDirection, IsThatOfTheWalls) {
  Rng rng(3);
  const RayCaster walls(test::niche_room().segments());
  for (int heading_deg = 0; heading_deg < 360; heading_deg += 7) {
    const Pose2 pose{3.0, 1.6, radians(heading_deg)};
    const Scan exact = Scan::make(test::sweep(walls, pose, 0.0, rng)).value();
    EXPECT_LT(apart(direction_of(exact), -pose.theta_rad), radians(0.25)) << heading_deg;
    const Scan noisy = Scan::make(test::sweep(walls, pose, 0.01, rng)).value();
    EXPECT_LT(apart(direction_of(noisy), -pose.theta_rad), radians(0.5)) << heading_deg;
    EXPECT_GE(direction_of(noisy), 0.0);
    EXPECT_LT(direction_of(noisy), kQuarter);
  }
}

TEST(DominantDirection, IsThatOfTheHoughSpectrum) {
  Rng rng(4);
  const RayCaster walls(test::rectangle(10, 6).segments());
  for (int k = 0; k < 8; ++k) {
    const Scan scan = Scan::make(test::sweep(walls, {3.0 + 0.4 * k, 2.5, 0.5 * k}, 0.01, rng)).value();
    EXPECT_LT(apart(direction_of(scan), dominant_twin(scan)), radians(0.75)) << k;
  }
}

TEST(DominantDirection, OfNothingIsZero) {
  RawScan raw{.angle_increment_rad = 0.01F, .range_min_m = 0.1F, .range_max_m = 10.0F};
  raw.ranges_m.assign(100, 0.0F);
  EXPECT_EQ(direction_of(Scan::make(raw).value()), 0.0);
}

TEST(Oc, FindsTheCornersOfARoomAtEveryHeading) {
  Rng rng(6);
  const RayCaster walls(test::rectangle(4, 4).segments());
  double error_sum = 0.0;
  int found = 0;
  int visible = 0;
  for (int heading_deg = 0; heading_deg < 360; ++heading_deg) {
    const Pose2 pose{2.2, 1.7, radians(heading_deg)};
    const auto keypoints = detect_oc(Scan::make(test::sweep(walls, pose, 0.01, rng)).value());
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {4, 0}, {4, 4}, {0, 4}}) {
      const Eigen::Vector2d seen = pose.inverse() * corner;
      if (std::abs(std::atan2(seen.y(), seen.x())) > radians(135.0) - 0.35 / seen.norm()) continue;
      ++visible;
      for (const Keypoint& keypoint : keypoints) {
        if ((keypoint.point - seen).norm() > 0.05) continue;
        ++found;
        error_sum += (keypoint.point - seen).norm();
        const Eigen::Vector2d inwards = pose.inverse() * Eigen::Vector2d(2, 2) - seen;
        EXPECT_LT(std::abs(wrap_angle(keypoint.orientation_rad - std::atan2(inwards.y(), inwards.x()))),
                  0.03);
        break;
      }
    }
  }
  ASSERT_GT(visible, 900);
  EXPECT_GE(found * 100, visible * 99);
  EXPECT_LT(error_sum / found, 0.004) << "metres";
}

/// Arms counted one by one from the definition.
TEST(Oc, CountsTheArmsAsDefined) {
  Rng rng(9);
  const RayCaster walls(test::niche_room().segments());
  OcConfig config;
  config.nms_radius_m = 0.0;  // every beam that qualifies
  config.min_score = 0.0;
  int compared = 0;
  int different = 0;
  for (int k = 0; k < 10; ++k) {
    const Scan scan = Scan::make(test::sweep(walls, {1.0 + 0.4 * k, 1.5, 0.4 * k}, 0.01, rng)).value();
    OcScratch scratch;
    std::vector<Keypoint> keypoints;
    detect_oc(scan, config, scratch, keypoints);
    const Eigen::Rotation2Dd turn(-scratch.direction_rad);
    for (const Keypoint& keypoint : keypoints) {
      int left = 0, right = 0, up = 0, down = 0, elsewhere = 0;
      for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector2d away = turn * (scan.point(i) - scan.point(keypoint.beam));
        const std::size_t place = scratch.around.points.begin() + i;
        const std::size_t centre = scratch.around.points.begin() + keypoint.beam;
        if (place < scratch.around.first[centre] || place > scratch.around.last[centre]) continue;
        if (away.norm() > keypoint.scale_m) continue;
        const bool near_x = std::abs(away.x()) < config.tolerance_m;
        const bool near_y = std::abs(away.y()) < config.tolerance_m;
        if (near_x && !near_y) ++(away.y() > 0.0 ? up : down);
        if (near_y && !near_x) ++(away.x() > 0.0 ? right : left);
        if (!near_x && !near_y) ++elsewhere;
      }
      const double on = std::max(left, right) + std::max(up, down);
      const double all = left + right + up + down + elsewhere;
      ++compared;
      different += std::abs(on / all - keypoint.score) > 1e-6 ? 1 : 0;
    }
  }
  ASSERT_GT(compared, 100);
  EXPECT_LE(different, compared / 50) << "of " << compared << "; on a limit it falls either way in float";
}

TEST(Oc, SurvivesAnything) {
  Rng rng(19);
  for (int k = 0; k < 200; ++k) {
    RawScan raw{.angle_min_rad = -3.0F,
                .angle_increment_rad = static_cast<float>(rng.uniform(0.002, 0.1)),
                .range_min_m = 0.0F,
                .range_max_m = 40.0F};
    const int beams = 1 + static_cast<int>(rng.uniform(0.0, 700.0));
    for (int i = 0; i < beams; ++i)
      raw.ranges_m.push_back(rng.uniform() < 0.3 ? std::numeric_limits<float>::infinity()
                                                 : static_cast<float>(rng.uniform(0.0, 3.0)));
    for (const char* preset : {"beaconless", "authors"})
      for (const Keypoint& keypoint : detect_oc(Scan::make(raw).value(), oc_preset(preset).value())) {
        ASSERT_TRUE(keypoint.point.allFinite());
        ASSERT_TRUE(std::isfinite(keypoint.score));
      }
  }
}

TEST(Oc, AllocatesNothingOnceItHasSeenAScan) {
  Rng rng(4);
  const RayCaster walls(test::niche_room().segments());
  std::vector<Scan> scans;
  for (int i = 0; i < 10; ++i)
    scans.push_back(Scan::make(test::sweep(walls, {3.0 + 0.05 * i, 2, 0.1 * i}, 0.01, rng)).value());
  OcScratch scratch;
  std::vector<Keypoint> keypoints;
  keypoints.reserve(1081);
  scratch.candidates.reserve(1081);
  detect_oc(scans[0], {}, scratch, keypoints);
  const std::size_t before = test::allocations();
  for (const Scan& scan : scans) detect_oc(scan, {}, scratch, keypoints);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_FALSE(keypoints.empty());
}

TEST(OcPreset, IsKnownByName) {
  EXPECT_DOUBLE_EQ(oc_preset("authors").value().tolerance_m, 0.1);
  EXPECT_FALSE(oc_preset("dissertations"));
  for (const char* name : {"beaconless", "authors"})
    EXPECT_TRUE(check_config(oc_preset(name).value())) << name;
}

}  // namespace
}  // namespace beaconless
