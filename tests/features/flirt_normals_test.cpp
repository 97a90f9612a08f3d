// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_normals.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// No smoothing at all.
ScaleKernel one_tap() {
  ScaleKernel kernel;
  kernel.weights = {1.0F};
  return kernel;
}

/// The definition: eigenvector of the scatter of each window, away from the sensor.
double direction_plainly(const FlirtContour& contour, std::size_t begin, std::size_t end) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = begin; i < end; ++i) mean += Eigen::Vector2d(contour.x_m[i], contour.y_m[i]);
  mean /= static_cast<double>(end - begin);
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = begin; i < end; ++i) {
    const Eigen::Vector2d arm = Eigen::Vector2d(contour.x_m[i], contour.y_m[i]) - mean;
    scatter += arm * arm.transpose();
  }
  Eigen::Vector2d normal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(0).normalized();
  if (normal.dot(mean) < 0.0) normal = -normal;
  return std::atan2(normal.y(), normal.x());
}

FlirtContour contour_of(const Scan& scan) {
  FlirtContour contour;
  gather_contour(scan, 0.0, 20, contour);
  return contour;
}

TEST(WallDirections, AgreeWithAFitPerWindow) {
  Rng rng(5);
  const RayCaster walls(test::niche_room().segments());
  const FlirtContour contour = contour_of(Scan::make(test::sweep(walls, {3, 2, 0.3}, 0.01, rng)).value());
  NormalScratch scratch;
  std::vector<float> directions;
  for (const std::size_t window : {3U, 11U, 31U}) {
    wall_directions(contour, one_tap(), window, scratch, directions);
    ASSERT_EQ(directions.size(), contour.size());
    for (const FlirtStretch& stretch : contour.stretches)
      for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
        const std::size_t begin = i > stretch.begin + window / 2 ? i - window / 2 : stretch.begin;
        const std::size_t end = std::min(i + window / 2 + 1, stretch.end);
        const double off = wrap_angle(directions[i] - direction_plainly(contour, begin, end));
        // Floats of up to 30 rad; where the normal is square to the view, either side is away from the
        // sensor.
        EXPECT_LT(std::min(std::abs(off), kPi - std::abs(off)), 1e-4) << window << " " << i;
        const double before = directions[i > stretch.begin ? i - 1 : i];
        EXPECT_LE(std::abs(directions[i] - before), kPi + 1e-5);
      }
  }
}

TEST(WallDirections, OfAWallIsItsNormalAllAlong) {
  Rng rng(1);
  const RayCaster walls(test::rectangle(8, 6).segments());
  const FlirtContour contour =
      contour_of(Scan::make(test::sweep(walls, {4, 1.5, 1.5 * kPi}, 0.0, rng)).value());
  NormalScratch scratch;
  std::vector<float> directions;
  wall_directions(contour, one_tap(), 5, scratch, directions);
  for (std::size_t i = 440; i < 640; ++i) EXPECT_NEAR(std::remainder(directions[i], 2.0 * kPi), 0.0, 1e-4);
}

TEST(WallDirections, OfPointsAllInOnePlaceAreFinite) {
  RawScan raw{.angle_increment_rad = 2e-6F, .range_min_m = 0.1F, .range_max_m = 30.0F};
  raw.ranges_m.assign(20, 2.0F);
  const FlirtContour contour = contour_of(Scan::make(raw).value());
  NormalScratch scratch;
  std::vector<float> directions;
  wall_directions(contour, one_tap(), 3, scratch, directions);
  for (const float direction : directions) EXPECT_TRUE(std::isfinite(direction));
}

TEST(SupportDirection, AgreesWithTheDefinition) {
  Rng rng(9);
  const RayCaster walls(test::niche_room().segments());
  const FlirtContour contour = contour_of(Scan::make(test::sweep(walls, {2, 2, 1.0}, 0.01, rng)).value());
  for (std::size_t i = 0; i + 9 < contour.size(); i += 7) {
    const double off =
        wrap_angle(support_direction(contour, i, i + 9) - direction_plainly(contour, i, i + 9));
    EXPECT_LT(std::min(std::abs(off), kPi - std::abs(off)), 1e-9) << i;
  }
}

}  // namespace
}  // namespace beaconless
