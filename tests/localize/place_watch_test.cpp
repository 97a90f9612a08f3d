// SPDX-License-Identifier: Apache-2.0
#include "beaconless/localize/place_watch.hpp"

#include <gtest/gtest.h>

#include "tests/support/rooms.hpp"

namespace beaconless {
namespace {

using Finding = PlaceWatch::Finding;

/// A watch over a robot that is believed at one pose and sees from another.
struct Watched {
  explicit Watched(const FloorPlan& plan)
      : walls(plan.segments()), finder({}, std::make_shared<const SurfaceMap>(WallIndex(plan)), {}, {}) {}

  Finding see(const Pose2& truth, const Pose2& believed, bool is_fitted = true) {
    const auto points = test::points_of(Scan::make(test::sweep(walls, truth, 0.01, rng)).value());
    return watch.see(Stamp::from_seconds(0.25 * scans++), points, believed, is_fitted);
  }

  RayCaster walls;
  PlaceFinder finder;
  PlaceWatch watch{finder};
  Rng rng{5};
  int scans = 0;
};

const Pose2 kNiche{2.0, 1.5, 0.4};

TEST(PlaceWatch, WithoutDoubtLooksAtNothing) {
  Watched robot(test::niche_room());
  EXPECT_EQ(robot.see(kNiche, {5.0, 4.0, 0.0}), Finding::beyond_doubt);
  EXPECT_TRUE(robot.finder.places().empty());
}

TEST(PlaceWatch, OneLookClearsAPlaceThatHasNotItsLike) {
  Watched robot(test::niche_room());
  robot.watch.doubt_followed(kNiche);
  ASSERT_TRUE(robot.watch.is_in_doubt());
  EXPECT_EQ(robot.see(kNiche, kNiche), Finding::beyond_doubt);
  EXPECT_FALSE(robot.watch.is_in_doubt());
}

TEST(PlaceWatch, AFitElsewhereThanTheRobotIsGivenUpAfterThreeLooks) {
  Watched robot(test::niche_room());
  const Pose2 believed{4.0, 3.0, 0.4};
  robot.watch.doubt_followed(believed);
  EXPECT_EQ(robot.see(kNiche, believed), Finding::rivalled);
  EXPECT_EQ(robot.see(kNiche, believed), Finding::rivalled);
  EXPECT_EQ(robot.see(kNiche, believed), Finding::elsewhere);
}

TEST(PlaceWatch, WhereTheScanDoesNotFitOneLookIsEnough) {
  Watched robot(test::niche_room());
  const Pose2 believed{4.0, 3.0, 0.4};
  robot.watch.doubt_followed(believed);
  EXPECT_EQ(robot.see(kNiche, believed, false), Finding::elsewhere);
}

TEST(PlaceWatch, LooksNoMoreThanTenTimesASecond) {
  Watched robot(test::niche_room());
  const Pose2 believed{4.0, 3.0, 0.4};
  robot.watch.doubt_followed(believed);
  const auto points = test::points_of(Scan::make(test::sweep(robot.walls, kNiche, 0.01, robot.rng)).value());
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(robot.watch.see(Stamp::from_seconds(0.025 * i), points, believed, true), Finding::rivalled)
        << i;
  EXPECT_EQ(robot.watch.see(Stamp::from_seconds(0.21), points, believed, true), Finding::elsewhere);
}

TEST(PlaceWatch, ARobotThatWasFollowedIsRivalledByWhatIsInReachAlone) {
  // The other end of a room that is the same turned: 1.7 m off is within reach, 6 m is not.
  for (const bool is_near : {true, false}) {
    Watched robot(is_near ? test::rectangle(3.0, 4.0) : test::rectangle(9.0, 6.0));
    const Pose2 pose = is_near ? Pose2{0.9, 1.4, 0.3} : Pose2{2.0, 2.0, 0.3};
    robot.watch.doubt_followed(pose);
    EXPECT_EQ(robot.see(pose, pose), is_near ? Finding::rivalled : Finding::beyond_doubt) << is_near;
    EXPECT_EQ(robot.watch.is_in_doubt(), is_near);
  }
}

TEST(PlaceWatch, APlaceThatWasFoundIsRivalledByAllOfTheMap) {
  Watched robot(test::rectangle(9.0, 6.0));
  const Pose2 pose{2.0, 2.0, 0.3};
  robot.finder.begin();
  const auto points = test::points_of(Scan::make(test::sweep(robot.walls, pose, 0.01, robot.rng)).value());
  ASSERT_EQ(robot.finder.see(Stamp::from_seconds(-0.25), points, std::nullopt),
            PlaceFinder::Verdict::several);
  robot.watch.doubt_found(Stamp::from_seconds(-0.25), pose);
  EXPECT_EQ(robot.watch.finding(), Finding::rivalled);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(robot.see(pose, pose), Finding::rivalled) << i;
}

TEST(PlaceWatch, AScanThatFitsNowhereChangesNothing) {
  Watched robot(test::niche_room());
  robot.watch.doubt_followed(kNiche);
  std::vector<Eigen::Vector2d> nonsense;
  for (int i = 0; i < 200; ++i)
    nonsense.emplace_back((2.0 + 0.1 * i) * std::cos(0.7 * i), (2.0 + 0.1 * i) * std::sin(0.7 * i));
  EXPECT_EQ(robot.watch.see(Stamp::from_seconds(0.0), nonsense, kNiche, true), Finding::in_doubt);
  EXPECT_TRUE(robot.watch.is_in_doubt());
}

TEST(PlaceWatch, APoseFarOffTheMapIsHeldAgainstTheNearestPartOfIt) {
  Watched robot(test::niche_room());
  const Pose2 believed{100.0, 100.0, 0.0};
  robot.watch.doubt_followed(believed);
  EXPECT_EQ(robot.see(kNiche, believed, false), Finding::elsewhere);
  ASSERT_FALSE(robot.finder.likely().empty());
  EXPECT_LT(distance_m(robot.finder.likely().front().map_from_laser, kNiche), 0.05);
}

TEST(PlaceWatch, DoubtThatIsThereAlreadyIsNotBegunAnew) {
  Watched robot(test::niche_room());
  const Pose2 believed{4.0, 3.0, 0.4};
  for (int i = 0; i < 3; ++i) {
    robot.watch.doubt_followed(believed);
    EXPECT_EQ(robot.see(kNiche, believed), i < 2 ? Finding::rivalled : Finding::elsewhere) << i;
  }
}

}  // namespace
}  // namespace beaconless
