// SPDX-License-Identifier: Apache-2.0
#include "beaconless/map/oblique_heading.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/geometry/angle.hpp"
#include "beaconless/geometry/pose2.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

FloorPlan turned(FloorPlan plan, double angle_rad) {
  for (auto& wall : plan.walls)
    for (auto& corner : wall) corner = Pose2{0.0, 0.0, angle_rad} * corner;
  return plan;
}

/// The mean offset, in cells, of the middles of the cells that a long wall at an angle to the rows is drawn
/// into. Source: the definition; cells stand for the wall as far as it runs through them.
double drawn_offset_cells(double angle_rad, double length_cells, double phase) {
  const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  double sum = 0.0;
  const int samples = static_cast<int>(50.0 * length_cells);
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d point = phase * across + (i + 0.5) / 50.0 * along;
    const Eigen::Vector2d middle = point.array().floor() + 0.5;
    sum += across.dot(middle - point);
  }
  return sum / samples;
}

TEST(ObliqueHeading, KeepsARectangularRoomOffTheRowsAndTheirDiagonals) {
  for (const double angle_deg : {0.0, 7.0, 33.0, 80.0}) {
    const double heading_rad = oblique_heading_rad(turned(test::rectangle(4.0, 3.0), radians(angle_deg)));
    EXPECT_GE(heading_rad, 0.0);
    EXPECT_LT(heading_rad, 0.5 * kPi);
    const double between = std::abs(std::remainder(radians(angle_deg) - heading_rad, 0.5 * kPi));
    EXPECT_GT(between, radians(10.0));
    EXPECT_LT(between, radians(35.0));
  }
}

TEST(ObliqueHeading, WallsDrawnAtItAreOffByALittleOfWhatTheyAreAlongTheRows) {
  const double heading_rad = oblique_heading_rad(test::rectangle(4.0, 3.0));
  double along_rows = 0.0;
  double oblique = 0.0;
  for (double phase = 0.05; phase < 1.0; phase += 0.1) {
    along_rows = std::max(along_rows, std::abs(drawn_offset_cells(0.0, 80.0, phase)));
    oblique = std::max(oblique, std::abs(drawn_offset_cells(-heading_rad, 80.0, phase)));
  }
  EXPECT_NEAR(along_rows, 0.45, 1e-6);
  EXPECT_LT(oblique, 0.02);
}

TEST(ObliqueHeading, LongWallsCountMoreThanShortOnes) {
  // Short walls at every heading but those of the long ones.
  FloorPlan plan = test::rectangle(10.0, 8.0);
  for (double angle_deg = 8.0; angle_deg < 83.0; angle_deg += 2.5)
    plan.walls.push_back(
        {{1.0, 1.0}, {1.0 + 0.1 * std::cos(radians(angle_deg)), 1.0 + 0.1 * std::sin(radians(angle_deg))}});
  EXPECT_GT(std::abs(std::remainder(oblique_heading_rad(plan), 0.5 * kPi)), radians(10.0));
}

TEST(ObliqueHeading, TurnsWithThePlan) {
  const FloorPlan plan = test::niche_room();
  const double between = std::abs(std::remainder(oblique_heading_rad(plan), 0.5 * kPi));
  // By a whole number of the headings that are tried. Either side of the walls is as good.
  const double angle_rad = radians(20.0);
  EXPECT_NEAR(std::abs(std::remainder(oblique_heading_rad(turned(plan, angle_rad)) - angle_rad, 0.5 * kPi)),
              between, 1e-9);
}

TEST(ObliqueHeading, OfNothingIsZero) {
  EXPECT_EQ(oblique_heading_rad({}), 0.0);
  EXPECT_EQ(oblique_heading_rad(FloorPlan{{{{1, 1}, {1, 1}}}}), 0.0);
}

}  // namespace
}  // namespace beaconless
