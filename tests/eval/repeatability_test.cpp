// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/repeatability.hpp"

#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace beaconless::eval {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// A 6 x 4 m room, seen from two places without noise.
class TwoViews : public testing::Test {
 protected:
  Repeatability compare(const Points& first, const Points& second) const {
    const std::vector<View> views = {{&first_scan, first_pose, first}, {&second_scan, second_pose, second}};
    return repeatability(views, 1);
  }
  /// A point of the map as the second scan has it.
  Eigen::Vector2d in_second(double x, double y) const {
    return second_pose.inverse() * Eigen::Vector2d(x, y);
  }
  Eigen::Vector2d in_first(double x, double y) const { return first_pose.inverse() * Eigen::Vector2d(x, y); }

  static Scan scan_at(const Pose2& pose) {
    Rng rng(1);
    const RayCaster walls(test::rectangle(6, 4).segments());
    return Scan::make(test::sweep(walls, pose, 0.0, rng)).value();
  }
  Pose2 first_pose{2, 2, 0.3};
  Pose2 second_pose{2.5, 1.8, 0.5};
  Scan first_scan = scan_at(first_pose);
  Scan second_scan = scan_at(second_pose);
};

TEST_F(TwoViews, CountsWhatIsFoundAgain) {
  const Repeatability of = compare({in_first(6, 4), in_first(6, 0)}, {in_second(6, 4.05), in_second(5.5, 0)});
  EXPECT_EQ(of.pair_count, 1U);
  EXPECT_EQ(of.visible_count, 2U);
  EXPECT_EQ(of.found_count, 1U);
  EXPECT_EQ(of.matched_count, 1U);
  EXPECT_DOUBLE_EQ(of.found_ratio(), 0.5);
  EXPECT_DOUBLE_EQ(of.points_per_scan(), 2.0);
  EXPECT_NEAR(of.mean_distance_m(), 0.05, 1e-12);
  EXPECT_NEAR(of.rms_distance_m(), 0.05, 1e-12);
}

TEST_F(TwoViews, LeavesOutWhatTheOtherScanCannotSee) {
  const Repeatability behind_a_wall = compare({in_first(7, 2)}, {});
  EXPECT_EQ(behind_a_wall.point_count, 1U);
  EXPECT_EQ(behind_a_wall.visible_count, 0U);
  const Eigen::Vector2d behind_the_scanner = second_pose * Eigen::Vector2d(-1.0, 0.0);
  EXPECT_EQ(compare({in_first(behind_the_scanner.x(), behind_the_scanner.y())}, {}).visible_count, 0U);
  EXPECT_EQ(compare({in_first(4, 3)}, {}).visible_count, 1U) << "free space in front of a wall can be seen";
}

TEST_F(TwoViews, TwoPointsCannotBothBeMatchedToOne) {
  const Repeatability of = compare({in_first(6, 4), in_first(5.98, 4)}, {in_second(6, 4)});
  EXPECT_EQ(of.found_count, 2U);
  EXPECT_EQ(of.matched_count, 1U);
  EXPECT_EQ(of.common_count, 1U);
  EXPECT_DOUBLE_EQ(of.matched_ratio(), 1.0);
}

TEST_F(TwoViews, OfNothingThereIsNothingToSay) {
  EXPECT_EQ(compare({}, {}).found_ratio(), 0.0);
  EXPECT_EQ(repeatability({}, 1).matched_ratio(), 0.0);
}

}  // namespace
}  // namespace beaconless::eval
