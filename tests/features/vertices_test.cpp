// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/vertices.hpp"

#include <gtest/gtest.h>

#include "beaconless/features/point_feature.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

Scan scan_of(const FloorPlan& plan, const Pose2& pose, double sigma_m) {
  Rng rng(1);
  const RayCaster walls(plan.segments());
  return Scan::make(test::sweep(walls, pose, sigma_m, rng)).value();
}

TEST(Vertices, AreTheCornersOfARoomToABeam) {
  const Pose2 pose{1.5, 1.2, 0.4};
  const auto found = find_vertices(scan_of(test::rectangle(4, 3), pose, 0.0));
  ASSERT_GE(found.size(), 3U);
  for (const Keypoint& keypoint : found) {
    const Eigen::Vector2d place = pose * keypoint.point;
    const Eigen::Vector2d corner(place.x() < 2 ? 0 : 4, place.y() < 1.5 ? 0 : 3);
    EXPECT_LT((place - corner).norm(), 0.03);
    const Eigen::Vector2d inwards = Eigen::Vector2d(2, 1.5) - corner;
    const double bisector = std::atan2(inwards.y() > 0 ? 1.0 : -1.0, inwards.x() > 0 ? 1.0 : -1.0);
    EXPECT_LT(std::abs(wrap_angle(keypoint.orientation_rad + pose.theta_rad - bisector)), radians(3.0));
  }
}

TEST(Vertices, NoiseOnAStraightWallMakesNone) {
  const FloorPlan wall{{{{-50, 2}, {50, 2}}}};
  EXPECT_TRUE(find_vertices(scan_of(wall, {}, 0.01)).empty());
}

TEST(Vertices, AnEdgeThatHidesAnotherIsNoCorner) {
  // A free-standing board before a wall: its ends are where it hides the wall.
  const FloorPlan plan{{{{-50, 5}, {50, 5}}, {{-1, 2}, {1, 2}}}};
  EXPECT_TRUE(find_vertices(scan_of(plan, {0, 0, radians(90.0)}, 0.0)).empty());
  EXPECT_TRUE(find_vertices(Scan::make({.angle_increment_rad = 0.01F, .ranges_m = {1.0F}}).value()).empty());
}

TEST(Vertices, AreADetectorLikeTheOthers) {
  const Scan scan = scan_of(test::niche_room(), {3, 2, 0}, 0.0);
  const auto features = find_point_features(scan, Detector::rdp);
  ASSERT_EQ(features.size(), find_vertices(scan).size());
  EXPECT_DOUBLE_EQ(features.front().covariance(0, 0), 0.03 * 0.03);
  EXPECT_EQ(detector_named("rdp").value(), Detector::rdp);
}

TEST(PointFeatures, CornersBringTheirOwnCovariance) {
  const Scan scan = scan_of(test::niche_room(), {3, 2, 0}, 0.0);
  const auto features = find_point_features(scan, Detector::corners);
  const auto corners = find_corners(scan);
  ASSERT_EQ(features.size(), corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_EQ(features[i].covariance, corners[i].covariance);
    EXPECT_EQ(features[i].opening_rad, corners[i].angle_rad);
  }
}

}  // namespace
}  // namespace beaconless
