// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/crb.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless::eval {
namespace {

RayCaster box(double width_m, double depth_m) {
  const FloorPlan plan{{{{0, 0}, {width_m, 0}, {width_m, depth_m}, {0, depth_m}, {0, 0}}}};
  return RayCaster(plan.segments());
}

RangeSensor all_round(int count) {
  RangeSensor sensor;
  for (int i = 0; i < count; ++i) sensor.angles_rad.push_back(2.0 * kPi * (i + 0.5) / count);
  return sensor;
}

Eigen::Vector3d sigmas(const Eigen::Matrix3d& covariance) { return covariance.diagonal().cwiseSqrt(); }

TEST(FisherInformation, SquareRoomHasAClosedForm) {
  // Derived by integrating over the beams: sigma sqrt(pi/2N) and sigma/a sqrt(3 pi/4N). The sum over N beams
  // differs from the integral by the second order in 1/N.
  const double a = 1.7;
  const int n = 14400;
  const auto bound = accuracy_bound(fisher_information(box(2 * a, 2 * a), all_round(n), {a, a, 0.3}));
  ASSERT_TRUE(bound);
  EXPECT_NEAR(sigmas(*bound).x(), 0.01 * std::sqrt(kPi / (2.0 * n)), 1e-5 * sigmas(*bound).x());
  EXPECT_NEAR(sigmas(*bound).y(), 0.01 * std::sqrt(kPi / (2.0 * n)), 1e-5 * sigmas(*bound).y());
  EXPECT_NEAR(sigmas(*bound).z(), 0.01 / a * std::sqrt(3.0 * kPi / (4.0 * n)), 1e-3 * sigmas(*bound).z());
}

TEST(FisherInformation, CircleTellsNoHeading) {
  // A polygon whose sides are met head-on by every beam.
  const int n = 720;
  FloorPlan::Polyline outline;
  for (int i = 0; i <= n; ++i)
    outline.emplace_back(3.0 * std::cos(2 * kPi * i / n), 3.0 * std::sin(2 * kPi * i / n));
  const RayCaster walls(FloorPlan{{outline}}.segments());
  const Eigen::Matrix3d information = fisher_information(walls, all_round(n), {});
  EXPECT_NEAR(information(0, 0), n / (2.0 * 1e-4), 1.0);
  EXPECT_NEAR(information(1, 1), n / (2.0 * 1e-4), 1.0);
  EXPECT_FALSE(accuracy_bound(information));
}

TEST(FisherInformation, CorridorTellsNothingAlongIt) {
  for (const double angle : {0.0, 0.7}) {
    const Pose2 turned{0, 0, angle};
    const Eigen::Vector2d far(1000.0, 0.0);
    const Eigen::Vector2d side(0.0, 1.25);
    const RayCaster walls(
        {{turned * (side - far), turned * (side + far)}, {turned * (-side - far), turned * (-side + far)}});
    const Eigen::Matrix3d information = fisher_information(walls, utm_30lx(), turned * Pose2{0, 0.2, 0.4});
    EXPECT_FALSE(accuracy_bound(information));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
    const Eigen::Vector3d blind = eigen.eigenvectors().col(0);
    EXPECT_NEAR(std::abs(blind.dot(Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0))), 1.0, 1e-6);
  }
  EXPECT_FALSE(accuracy_bound(fisher_information(RayCaster({}), utm_30lx(), {})));
}

TEST(FisherInformation, KnownRooms) {
  struct Known {
    double width_m = 0.0;
    double depth_m = 0.0;
    Pose2 pose;
    double x_mm = 0.0;  // as printed: correct to half of the last digit
    double y_mm = 0.0;
    double theta_deg = 0.0;
  };
  // Made by an independent program for the UTM-30LX pattern at 10 mm.
  for (const Known& k : {Known{4, 4, {2, 2, 0}, 0.466, 0.330, 0.0134},
                         {10, 6, {3, 2, radians(30)}, 0.507, 0.376, 0.0056},
                         {30, 20, {12, 8, radians(20)}, 0.535, 0.338, 0.0020}}) {
    const auto bound = accuracy_bound(fisher_information(box(k.width_m, k.depth_m), utm_30lx(), k.pose));
    ASSERT_TRUE(bound);
    EXPECT_NEAR(1e3 * sigmas(*bound).x(), k.x_mm, 0.00051);
    EXPECT_NEAR(1e3 * sigmas(*bound).y(), k.y_mm, 0.00051);
    EXPECT_NEAR(degrees(sigmas(*bound).z()), k.theta_deg, 0.000051);
  }
}

TEST(FisherInformation, IsThatOfNumericDerivatives) {
  Rng rng(1);
  std::vector<Segment2> walls = box(9.0, 6.0).segments();
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector2d a(rng.uniform(0, 9), rng.uniform(0, 6));
    walls.push_back({a, a + Eigen::Vector2d(rng.normal(0.5), rng.normal(0.5))});
  }
  const RayCaster caster(walls);
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    const Pose2 at{rng.uniform(1, 8), rng.uniform(1, 5), rng.uniform(-3, 3)};
    RangeSensor sensor;
    sensor.angles_rad = {rng.uniform(-3, 3)};
    sensor.sigma_m = 0.02;
    sensor.range_min_m = 0.0;
    const auto cast = [&](const Pose2& pose) {
      const double heading = pose.theta_rad + sensor.angles_rad[0];
      return *caster.cast(pose.translation(), {std::cos(heading), std::sin(heading)}, 30.0);
    };
    Eigen::Vector3d slope;
    bool one_wall = cast(at).cos_incidence > 0.05;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d nudge = kStep * Eigen::Vector3d::Unit(i);
      const auto plus = cast({at.x_m + nudge.x(), at.y_m + nudge.y(), at.theta_rad + nudge.z()});
      const auto minus = cast({at.x_m - nudge.x(), at.y_m - nudge.y(), at.theta_rad - nudge.z()});
      one_wall = one_wall && plus.segment == cast(at).segment && minus.segment == plus.segment;
      slope[i] = (plus.range_m - minus.range_m) / (2.0 * kStep);
    }
    if (!one_wall) continue;
    const Eigen::Matrix3d expected = slope * slope.transpose() / (0.02 * 0.02);
    const Eigen::Matrix3d found = fisher_information(caster, sensor, at);
    EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm()) << at;
  }
}

TEST(AccuracyBound, OfTheBaseIsTheInverseOfItsOwnInformation) {
  const RayCaster walls = box(7.0, 5.0);
  const Pose2 map_from_base{2.5, 2.0, 0.6};
  const Pose2 base_from_laser{0.7, 0.1, 0.2};
  const auto base = accuracy_bound(walls, utm_30lx(), map_from_base, base_from_laser);
  ASSERT_TRUE(base);
  const Eigen::Matrix3d of_laser = fisher_information(walls, utm_30lx(), map_from_base * base_from_laser);
  Eigen::Matrix3d laser_per_base = Eigen::Matrix3d::Identity();
  const Eigen::Vector2d arm = map_from_base.rotation() * base_from_laser.translation();
  laser_per_base(0, 2) = -arm.y();
  laser_per_base(1, 2) = arm.x();
  const Eigen::Matrix3d expected = (laser_per_base.transpose() * of_laser * laser_per_base).inverse();
  EXPECT_LT((*base - expected).norm(), 1e-9 * expected.norm());
}

TEST(CrbRatio, IsOneForErrorsAsLargeAsTheBound) {
  std::vector<PoseError> errors;
  std::vector<std::optional<Eigen::Matrix3d>> bounds;
  for (int i = 0; i < 4; ++i) {
    PoseError error;
    error.x_m = 3e-3;
    error.y_m = -4e-3;
    error.heading_rad = -2e-3;
    errors.push_back(error);
    bounds.emplace_back(Eigen::Matrix3d(Eigen::Vector3d(1e-6, 24e-6, 1e-6).asDiagonal()));
  }
  errors[3].x_m = 99.0;
  bounds[3].reset();
  const auto ratio = crb_ratio(errors, bounds);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(ratio->position, 1.0, 1e-12);
  EXPECT_NEAR(ratio->heading, 2.0, 1e-12);
  EXPECT_FALSE(crb_ratio({}, {}));
  EXPECT_FALSE(crb_ratio(std::span(errors).last(1), std::span(bounds).last(1)));
}

TEST(SensorOf, AScan) {
  RawScan raw;
  raw.angle_min_rad = -0.5F;
  raw.angle_increment_rad = 0.25F;
  raw.range_min_m = 0.1F;
  raw.range_max_m = 30.0F;
  raw.ranges_m = {1.0F, 2.0F, 3.0F};
  const RangeSensor sensor = sensor_of(Scan::make(raw).value(), 0.03);
  EXPECT_EQ(sensor.angles_rad, (std::vector{-0.5, -0.25, 0.0}));
  EXPECT_EQ(sensor.sigma_m, 0.03);
  EXPECT_NEAR(sensor.range_max_m, 30.0, 1e-6);
}

// ---- bounds that another program computed ----

std::filesystem::path data_directory() {
  const char* told = std::getenv("BEACONLESS_DATA");
  return told != nullptr ? told : std::string(BEACONLESS_SOURCE_DIR) + "/../shared/data";
}

/// The numbers of each line that is no comment; brackets and commas are taken for spaces.
std::vector<std::vector<double>> rows(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::vector<double>> found;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#") || line.starts_with("walls")) continue;
    for (char& c : line)
      if (c == '[' || c == ']' || c == ',' || (c == '-' && line.find("- ") == std::size_t(&c - line.data())))
        c = ' ';
    std::istringstream words(line);
    std::vector<double> row;
    for (double value = 0.0; words >> value;) row.push_back(value);
    if (!row.empty()) found.push_back(row);
  }
  return found;
}

class Witness : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Witness, AgreesOnTheBoundOfEveryScan) {
  const auto rooms = data_directory() / "sim_rooms";
  if (!std::filesystem::exists(rooms)) GTEST_SKIP() << rooms << " is not there; set BEACONLESS_DATA";
  FloorPlan plan;
  for (const auto& row : rows(rooms / (std::string(GetParam().second) + ".plan.yaml"))) {
    plan.walls.emplace_back();
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) plan.walls.back().emplace_back(row[i], row[i + 1]);
  }
  const RayCaster walls(plan.segments());
  const auto truth = rows(rooms / (std::string(GetParam().first) + ".truth.tum"));
  const auto expected = rows(rooms / (std::string(GetParam().first) + ".crb.txt"));
  ASSERT_EQ(truth.size(), expected.size());
  ASSERT_GE(truth.size(), 400U);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose2 pose{truth[i][1], truth[i][2], 2.0 * std::atan2(truth[i][6], truth[i][7])};
    const auto bound = accuracy_bound(fisher_information(walls, utm_30lx(), pose));
    ASSERT_TRUE(bound);
    for (int k = 0; k < 3; ++k) {
      const double ratio = sigmas(*bound)[k] / expected[i][static_cast<std::size_t>(k) + 1];
      // The files' four digits explain 5e-4; poses of six decimals as much again where a beam grazes.
      EXPECT_NEAR(ratio, 1.0, 1e-3) << "scan " << i << ", component " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SimRooms, Witness,
                         testing::Values(std::pair{"a1_static", "a_room4x3"},
                                         std::pair{"b1_ellipse", "b_room12x8"}));

}  // namespace
}  // namespace beaconless::eval
