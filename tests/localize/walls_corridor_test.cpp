// SPDX-License-Identifier: Apache-2.0
// A corridor whose ends are out of range: its walls tell how far it is across, and nothing along.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "beaconless/eval/crb.hpp"
#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/match/walls.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

constexpr double kLength_m = 50.0;
constexpr double kWidth_m = 2.5;
constexpr double kReach_m = 15.0;  // of the laser: no end is in view between 15 and 35 m
constexpr double kSpeed_mps = 1.2;
constexpr std::int64_t kStep_ns = 25'000'000;

/// The corridor lies askew in the map.
const Pose2 kMapFromAxis{4.0, -2.0, 0.3};

FloorPlan corridor() {
  FloorPlan plan = test::rectangle(kLength_m, kWidth_m);
  for (auto& wall : plan.walls)
    for (Eigen::Vector2d& corner : wall) corner = kMapFromAxis * corner;
  return plan;
}

/// A scanner of a whole turn that sees as far as it reaches.
RawScan see(const RayCaster& walls, const Pose2& from, Rng& rng, Stamp stamp = {}) {
  RawScan raw{.stamp = stamp,
              .angle_min_rad = static_cast<float>(-kPi),
              .angle_increment_rad = static_cast<float>(radians(1.0 / 3.0)),
              .range_min_m = 0.1F,
              .range_max_m = static_cast<float>(kReach_m)};
  for (int i = 0; i < 1080; ++i) {
    const double heading = from.theta_rad + static_cast<double>(raw.angle_min_rad) +
                           i * static_cast<double>(raw.angle_increment_rad);
    const auto hit = walls.cast(from.translation(), {std::cos(heading), std::sin(heading)}, kReach_m);
    raw.ranges_m.push_back(hit ? static_cast<float>(hit->range_m + rng.normal(0.01))
                               : std::numeric_limits<float>::infinity());
  }
  return raw;
}

/// What a scan allows to know across the corridor, nothing being known along.
double sigma_across_m(const RayCaster& walls, const Scan& scan, const Pose2& truth) {
  eval::RangeSensor sensor = eval::sensor_of(scan);
  sensor.range_max_m = kReach_m;
  const Eigen::Matrix3d information = eval::fisher_information(walls, sensor, truth);
  Eigen::Matrix3d to_axis = Eigen::Matrix3d::Identity();
  to_axis.topLeftCorner<2, 2>() = kMapFromAxis.rotation();
  const Eigen::Matrix3d along = to_axis.transpose() * information * to_axis;
  return std::sqrt(along.bottomRightCorner<2, 2>().inverse()(0, 0));
}

TEST(WallsCorridor, LeavesOpenWhatLiesAlongTheAxis) {
  const RayCaster walls(corridor().segments());
  const WallIndex index(corridor());
  WallsScratch scratch;
  Rng rng(81);
  for (int run = 0; run < 200; ++run) {
    const Pose2 truth =
        kMapFromAxis * Pose2{rng.uniform(16, 34), rng.uniform(0.5, 2.0), rng.uniform(-kPi, kPi)};
    const Pose2 guess = truth * Pose2{rng.uniform(-0.01, 0.01), rng.uniform(-0.01, 0.01), 0.002};
    const Scan scan = Scan::make(see(walls, truth, rng)).value();
    const MatchResult match = match_walls(test::points_of(scan), index, guess, 0.03, {}, scratch);
    ASSERT_EQ(match.rank, 2);
    const Eigen::Vector2d weak = match.weak_direction.head<2>().normalized();
    ASSERT_GT(std::abs(weak.dot(kMapFromAxis.rotation().col(0))), std::cos(radians(0.1)));
    const double across_m =
        (kMapFromAxis.inverse() * match.map_from_laser).y_m - (kMapFromAxis.inverse() * truth).y_m;
    ASSERT_LT(std::abs(across_m), 5.0 * sigma_across_m(walls, scan, truth));
  }
}

/// Where a robot is that drives along the corridor, a little from side to side.
Pose2 driven(double x_m) {
  const double side = std::sin(0.5 * x_m);
  return kMapFromAxis * Pose2{x_m, 1.25 + 0.3 * side, std::atan(0.15 * std::cos(0.5 * x_m))};
}

class CorridorDrive : public testing::TestWithParam<bool> {};  // with wheels or without

TEST_P(CorridorDrive, IsDegradedWithoutDriftAcrossAndOkWhereAnEndIsInSight) {
  const RayCaster walls(corridor().segments());
  const auto localizer = make_localizer({.method = "walls"}, corridor()).value();
  Rng rng(82);
  localizer->start_at(driven(8.0));
  int in_corridor = 0;
  int beyond = 0;
  double worst_sigmas = 0.0;
  PoseEstimate estimate;
  for (std::int64_t tick = 0;; ++tick) {
    const double x_m = 8.0 + kSpeed_mps * 1e-9 * static_cast<double>(tick * kStep_ns);
    if (x_m > 38.0) break;
    const Pose2 truth = driven(x_m);
    const Stamp stamp{tick * kStep_ns};
    if (GetParam())
      localizer->update(Odometry{.stamp = stamp, .odom_from_base = driven(8.0).inverse() * truth});
    const Scan scan = Scan::make(see(walls, truth, rng, stamp)).value();
    estimate = localizer->update(scan);
    const Pose2 found = kMapFromAxis.inverse() * estimate.map_from_base;
    const Pose2 real = kMapFromAxis.inverse() * truth;
    // Near where an end comes into sight a beam or two see it, and which is a matter of noise.
    if (x_m > 15.2 && x_m < 34.8) {
      ++in_corridor;
      ASSERT_EQ(estimate.status, Status::degraded) << x_m;
      ASSERT_NE(estimate.reason.find("direction open"), std::string_view::npos) << estimate.reason;
    } else if (x_m < 14.0 || x_m > 36.0) {
      ASSERT_TRUE(estimate.ok()) << x_m << " " << estimate.reason;
      ASSERT_LT(distance_m(found, real), 0.1) << x_m;
    }
    if (x_m > 34.8) ++beyond;
    // A path that bends: across the corridor where the robot is thought to be.
    const double sigmas = std::abs(found.y_m - real.y_m) / sigma_across_m(walls, scan, truth);
    worst_sigmas = std::max(worst_sigmas, sigmas);
  }
  EXPECT_GT(in_corridor, 500);
  EXPECT_GT(beyond, 50);
  EXPECT_LT(worst_sigmas, 5.0);
}

INSTANTIATE_TEST_SUITE_P(Wheels, CorridorDrive, testing::Bool(),
                         [](const auto& has) { return has.param ? "with_wheels" : "without"; });

}  // namespace
}  // namespace beaconless
