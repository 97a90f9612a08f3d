// SPDX-License-Identifier: Apache-2.0
// A robot that nobody tells where it is, and one that is carried away.
#include <algorithm>

#include <gtest/gtest.h>

#include "beaconless/localize/make_localizer.hpp"

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

/// Scans from places in a building, a tenth of a second apart.
struct Robot {
  Robot(const FloorPlan& plan, const std::optional<SearchRegion>& within, const LocalizerConfig& config = {})
      : walls(plan.segments()), localizer(make_localizer(config, plan).value()) {
    localizer->start_anywhere(within);
  }

  PoseEstimate see_from(const Pose2& pose) {
    const RawScan raw = test::sweep(walls, pose, 0.01, rng, Stamp::from_seconds(0.1 * scans++));
    PoseEstimate estimate = localizer->update(Scan::make(raw).value());
    EXPECT_TRUE(estimate.map_from_base.is_finite() && estimate.covariance.allFinite());
    EXPECT_TRUE(std::isfinite(estimate.quality) && std::isfinite(estimate.protection_m) &&
                std::isfinite(estimate.protection_rad));
    const auto candidates = localizer->candidates();
    if (estimate.status == Status::relocalizing) {
      double weights = 0.0;
      for (const PoseCandidate& candidate : candidates) {
        weights += candidate.weight;
        EXPECT_TRUE(candidate.map_from_base.is_finite());
        EXPECT_TRUE(candidate.score >= 0.0 && candidate.score <= 1.0);
      }
      EXPECT_NEAR(weights, 1.0, 1e-9);
    }
    return estimate;
  }

  RayCaster walls;
  std::unique_ptr<Localizer> localizer;
  Rng rng{9};
  int scans = 0;
};

TEST(StartAnywhere, InARoomWithoutSymmetryTheFirstScanIsOk) {
  Robot robot(test::niche_room(), {});
  const Pose2 pose{2.0, 1.5, 0.4};
  for (int i = 0; i < 5; ++i) {
    const PoseEstimate estimate = robot.see_from(pose);
    ASSERT_EQ(estimate.status, Status::ok) << i << estimate.reason;
    EXPECT_LT(distance_m(estimate.map_from_base, pose), 0.02);
    EXPECT_FALSE(estimate.jumped);  // there was no belief to change
  }
}

TEST(StartAnywhere, InASymmetricRoomNoPoseIsEverOk) {
  Robot robot(test::rectangle(6.0, 4.0), {});
  for (int i = 0; i < 60; ++i) {
    const PoseEstimate estimate = robot.see_from({1.5 + 0.04 * i, 1.3 + 0.02 * i, 0.3 + 0.05 * i});
    ASSERT_EQ(estimate.status, Status::relocalizing) << i;
    EXPECT_EQ(robot.localizer->candidates().size(), 2U);
  }
}

TEST(StartAnywhere, WithinARegionThatHoldsOneOfTwoPlacesTheFirstScanIsOk) {
  const Pose2 pose{1.5, 1.3, 0.3};
  Robot robot(test::rectangle(6.0, 4.0), SearchRegion{{1.5, 1.0}, 1.0});
  const PoseEstimate estimate = robot.see_from(pose);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.reason;
  EXPECT_LT(distance_m(estimate.map_from_base, pose), 0.02);
}

TEST(StartAnywhere, ARegionIsADiscNotTheSquareAroundIt) {
  // The like place, {4.5, 2.7} turned, is in the square around the disc but not in the disc.
  const Pose2 pose{1.5, 1.3, 0.3};
  Robot robot(test::rectangle(6.0, 4.0), SearchRegion{{2.3, 0.5}, 2.3});
  const PoseEstimate estimate = robot.see_from(pose);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.reason;
  EXPECT_LT(distance_m(estimate.map_from_base, pose), 0.02);
}

TEST(StartAnywhere, ARegionIsOfTheBaseWhereverTheLaserIs) {
  LocalizerConfig config;
  config.base_from_laser = Pose2{0.8, 0.0, 0.0};
  const Pose2 base{4.9, 4.0, 0.1};
  Robot robot(test::niche_room(), SearchRegion{{4.2, 4.0}, 0.75}, config);
  const PoseEstimate estimate = robot.see_from(base * config.base_from_laser);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.reason;
  EXPECT_LT(distance_m(estimate.map_from_base, base), 0.02);
}

/// Two like rooms, and a third 70 m off that is like no other.
FloorPlan far_apart(bool with_look_alike) {
  FloorPlan plan;
  const auto add = [&plan](const FloorPlan& room, double x_m) {
    for (FloorPlan::Polyline wall : room.walls) {
      for (Eigen::Vector2d& corner : wall) corner.x() += x_m;
      plan.walls.push_back(wall);
    }
  };
  add(test::rectangle(6.0, 4.5), 0.0);
  if (with_look_alike) add(test::niche_room(), 15.0);
  add(test::niche_room(), 70.0);
  // What tells the third room from the second: a pillar by the wall.
  plan.walls.push_back({{70.5, 0.5}, {71.3, 0.5}, {71.3, 1.0}, {70.5, 1.0}, {70.5, 0.5}});
  return plan;
}

TEST(StartAnywhere, CarriedFurtherThanALookAlikeItIsFoundWhereItIs) {
  for (const bool with_look_alike : {false, true}) {
    Robot robot(far_apart(with_look_alike), SearchRegion{{3.0, 2.0}, 4.0});
    robot.localizer->start_at({2.0, 1.5, 0.4});
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(robot.see_from({2.0, 1.5, 0.4}).ok()) << i;
    PoseEstimate estimate;
    const Pose2 after{74.0, 3.0, 2.0};
    for (int i = 0; i < 60; ++i) {
      estimate = robot.see_from(after);
      if (estimate.ok()) {
        ASSERT_LT(distance_m(estimate.map_from_base, after), 0.1) << i << with_look_alike;
      }
    }
    EXPECT_TRUE(estimate.ok()) << with_look_alike << ": " << estimate.reason;
  }
}

TEST(StartAnywhere, ARegionIsOfTheStartNotOfTheDriveFromThere) {
  // The like place of a rectangle is ruled out by the region, wherever the robot goes.
  Robot robot(test::rectangle(9.0, 6.0), SearchRegion{{2.0, 2.0}, 1.5});
  for (int i = 0; i < 100; ++i) {
    const Pose2 pose{1.5 + 0.05 * i, 1.5 + 0.02 * i, 0.3};
    const PoseEstimate estimate = robot.see_from(pose);
    ASSERT_TRUE(estimate.ok()) << i << estimate.reason;
    ASSERT_LT(distance_m(estimate.map_from_base, pose), 0.05) << i;
  }
}

TEST(StartAnywhere, CarriedToWhereSomethingNearFitsWellEnoughItIsNeverOkAndWrong) {
  // Racks repeat: half a metre and a turn beside the robot most of the scan fits once more.
  Robot robot(test::rack_hall(), {});
  const Pose2 before{1.2, 1.2, 0.2};
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(robot.see_from(before).ok()) << i;
  for (const Pose2& after : {Pose2{1.7, 1.5, 0.5}, Pose2{4.1, 1.2, 0.2}, Pose2{22.8, 12.8, 0.2 - kPi}}) {
    for (int i = 0; i < 60; ++i) {
      const PoseEstimate estimate = robot.see_from(after);
      if (estimate.ok()) {
        ASSERT_LT(distance_m(estimate.map_from_base, after), 0.1) << after << i;
      }
    }
  }
}

TEST(StartAnywhere, WhatHasNotItsLikeIsTrustedAtOnce) {
  Robot robot(test::niche_room(), {});
  EXPECT_TRUE(robot.see_from({2.0, 1.5, 0.4}).is_trusted());
}

TEST(StartAnywhere, WhatASmallThingAloneTellsFromAnotherPlaceIsOkAndNotTrusted) {
  FloorPlan plan = test::niche_room();
  FloorPlan::Polyline other = plan.walls.front();
  for (Eigen::Vector2d& corner : other) corner.x() += 12.0;
  plan.walls.push_back(other);
  plan.walls.push_back({{3.5, 1.5}, {3.8, 1.5}, {3.8, 1.8}, {3.5, 1.8}, {3.5, 1.5}});  // in one of them
  Robot robot(plan, {});
  for (int i = 0; i < 10; ++i) {
    const PoseEstimate estimate = robot.see_from({2.0, 1.5, 0.4});
    EXPECT_TRUE(estimate.ok()) << estimate.reason;
    EXPECT_LT(distance_m(estimate.map_from_base, {2.0, 1.5, 0.4}), 0.02);
    EXPECT_FALSE(estimate.is_trusted());
  }
}

TEST(StartAnywhere, ARobotThatIsCarriedAwayIsLostThenFoundAndSaysThatItJumped) {
  Robot robot(test::rack_hall(), {});
  const Pose2 before{1.2, 1.2, 0.2};
  const Pose2 after{22.5, 6.0, 2.0};
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(robot.see_from(before).ok()) << i;
  std::vector<PoseEstimate> estimates;
  estimates.reserve(80);
  for (int i = 0; i < 80; ++i) estimates.push_back(robot.see_from(after));
  const auto first_ok =
      std::find_if(estimates.begin(), estimates.end(), [](const PoseEstimate& e) { return e.ok(); });
  ASSERT_NE(first_ok, estimates.end());
  EXPECT_LT(distance_m(first_ok->map_from_base, after), 0.05);
  EXPECT_TRUE(first_ok->jumped);
  EXPECT_TRUE(std::any_of(estimates.begin(), first_ok, [](const PoseEstimate& e) {
    return e.status == Status::lost || e.status == Status::relocalizing;
  }));
  for (auto later = first_ok + 1; later != estimates.end(); ++later) {
    EXPECT_TRUE(later->ok());
    EXPECT_FALSE(later->jumped);
  }
}

}  // namespace
}  // namespace beaconless
