// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/node.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/fake_localizer.hpp"
#include "tests/ros1/fake_link.hpp"

namespace beaconless::ros1 {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kTenth_ns = 100'000'000;

/// A node with a localizer that believes what it is told.
class NodeTest : public testing::Test {
 protected:
  NodeTest() { settings.has_initial_pose = true; }

  Node& node() {
    if (!node_) {
      node_.emplace(settings, link, [this](const LocalizerConfig& config, const Map&) {
        if (is_map_refused) return Result<std::unique_ptr<Localizer>>(Error{"map", "no walls", ""});
        auto made = std::make_unique<FakeLocalizer>();
        made->after_start_at = {{.map_from_base = {3.0, 4.0, 0.5}}};
        made->after_start_anywhere = {
            {.status = Status::relocalizing,
             .candidates = {{{1.0, 1.0, 0.0}, 0.9, 0.5}, {{2.0, 1.0, 0.0}, 0.9, 0.5}}}};
        localizer = made.get();
        config_seen = config;
        return Result<std::unique_ptr<Localizer>>(std::move(made));
      });
    }
    return *node_;
  }

  void give_map() { node().hear_map({"map", 0.5, 2, 2, {}, {100, 0, 0, 100}}); }
  void give_laser() { link.transforms[{"base_link", "laser"}] = FakeLink::known(0.2, 0.0); }
  void give_wheels() { link.transforms[{"odom", "base_link"}] = FakeLink::known(1.0, 0.0); }

  void scan(std::int64_t tenths, const std::string& frame = "laser") {
    node().hear_scan({.stamp_ns = tenths * kTenth_ns,
                      .frame_id = frame,
                      .angle_min_rad = 0.0F,
                      .angle_increment_rad = 0.1F,
                      .range_max_m = 10.0F,
                      .ranges_m = {1.0F, 2.0F}});
  }

  std::string diagnosed() {
    link.steady += 1.1;
    node().tick();
    std::string all = link.diagnostics.back().message;
    for (const auto& [key, value] : link.diagnostics.back().values) all += "\n" + key + ": " + value;
    return all;
  }

  FakeLink link;
  Settings settings;
  FakeLocalizer* localizer = nullptr;
  bool is_map_refused = false;
  LocalizerConfig config_seen;

 private:
  std::optional<Node> node_;
};

TEST_F(NodeTest, TellsMapFromOdomWhereThereAreWheels) {
  give_map(), give_laser(), give_wheels();
  scan(10);
  ASSERT_THAT(link.poses, SizeIs(1));
  EXPECT_EQ(link.poses[0].pose.x_m, 3.0);
  EXPECT_EQ(config_seen.base_from_laser.x_m, 0.2);
  EXPECT_EQ(localizer->odometry_count, 1U);
  ASSERT_THAT(link.sent_transforms, SizeIs(1));
  const TransformMessage& sent = link.sent_transforms[0];
  EXPECT_EQ(sent.child_frame_id, "odom");
  EXPECT_EQ(sent.stamp_ns, 11 * kTenth_ns);  // a tenth ahead
  // The base lies 1 m ahead in odom: map from odom times that is the pose.
  EXPECT_NEAR(sent.transform.x_m + std::cos(0.5), 3.0, 1e-12);
  EXPECT_NEAR(sent.transform.y_m + std::sin(0.5), 4.0, 1e-12);
}

TEST_F(NodeTest, TellsMapFromBaseWhereWheelsHaveNotComeForASecond) {
  give_map(), give_laser();
  for (const int tenths : {10, 15}) scan(tenths);
  EXPECT_THAT(link.sent_transforms, IsEmpty());
  scan(21);
  ASSERT_THAT(link.sent_transforms, SizeIs(1));
  EXPECT_EQ(link.sent_transforms[0].child_frame_id, "base_link");
  EXPECT_THAT(link.poses, SizeIs(3));
}

TEST_F(NodeTest, NeverTakesAMissingLaserForAnIdentity) {
  give_map(), give_wheels();
  scan(10);
  link.steady += 3.0;
  node().tick();
  EXPECT_THAT(link.poses, IsEmpty());
  EXPECT_EQ(localizer, nullptr);
  EXPECT_THAT(diagnosed(), HasSubstr("where the laser \"laser\" sits on \"base_link\" is not known"));
  // It comes later, and all is well.
  give_laser();
  scan(20);
  EXPECT_THAT(link.poses, SizeIs(1));
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("sits on")));
}

TEST_F(NodeTest, WaitsForAllItsLasersAndTellsThemApartByTheirFrames) {
  settings.node.scan_topics = "/front, /rear";
  give_map(), give_wheels();
  link.transforms[{"base_link", "front"}] = FakeLink::known(0.3, 0.0);
  link.transforms[{"base_link", "rear"}] = FakeLink::known(-0.3, 0.0, 1.0, 0.0);
  scan(10, "front");
  EXPECT_THAT(link.poses, IsEmpty());
  scan(10, "rear");  // of the same moment, which is no repetition
  EXPECT_THAT(link.poses, SizeIs(2));
  ASSERT_THAT(config_seen.lasers, SizeIs(2));
  EXPECT_EQ(config_seen.lasers[0].frame_id, "front");
  EXPECT_EQ(config_seen.lasers[1].base_from_laser.x_m, -0.3);
  EXPECT_EQ(localizer->odometry_count, 1U);      // that moment's wheels are told on once …
  EXPECT_THAT(link.sent_transforms, SizeIs(1));  // … and so is its tf, which refuses repetitions
  scan(11, "top");
  EXPECT_THAT(link.poses, SizeIs(2));
  EXPECT_THAT(diagnosed(), HasSubstr("scans of \"top\" are passed over: the laser is \"front\", \"rear\""));
}

TEST_F(NodeTest, SaysWhichLaserHasFallenSilent) {
  settings.node.scan_topics = "/front /rear";
  give_map(), give_wheels();
  link.transforms[{"base_link", "front"}] = link.transforms[{"base_link", "rear"}] =
      FakeLink::known(0.3, 0.0);
  scan(10, "front"), scan(10, "rear");
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("no scan for")));
  for (int i = 0; i < 4; ++i) {
    link.steady += 1.0;
    scan(20 + i, "front"), scan(20 + i, "top");
  }
  EXPECT_THAT(diagnosed(),
              testing::AllOf(HasSubstr("no scan of \"rear\" for"), testing::Not(HasSubstr("of \"front\""))));
}

TEST_F(NodeTest, SaysThatALaserWasNeverHeard) {
  settings.node.scan_topics = "/front /raer";
  give_map(), give_wheels();
  link.transforms[{"base_link", "front"}] = FakeLink::known(0.3, 0.0);
  scan(10, "front");
  for (int i = 0; i < 4; ++i) {
    link.steady += 1.0;
    scan(20 + i, "front");
  }
  EXPECT_THAT(diagnosed(), HasSubstr("scans of 1 of 2 lasers are heard"));
  scan(30, "rear");
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("lasers are heard")));
}

TEST_F(NodeTest, TellsNoPoseThatNoScanHasConfirmed) {
  give_map(), give_laser(), give_wheels();
  node();
  scan(9);
  localizer->after_start_at = {
      {.status = Status::degraded}, {.status = Status::ok}, {.status = Status::degraded}};
  node().hear_initial_pose({0, "map", {1.0, 0.0}, {}});
  const std::size_t before = link.poses.size();
  const std::size_t sent_before = link.sent_transforms.size();
  scan(10);
  EXPECT_EQ(link.poses.size(), before);
  EXPECT_EQ(link.sent_transforms.size(), sent_before);
  scan(11), scan(12);
  EXPECT_EQ(link.poses.size(), before + 2) << "one that has been, coasts on";
}

TEST_F(NodeTest, SaysThatThereIsNoMapEvenWhereThereIsNoScan) {
  link.steady += 3.0;
  node();
  link.steady += 3.0;
  EXPECT_THAT(diagnosed(), testing::AllOf(HasSubstr("no map yet"), HasSubstr("no scan for")));
}

TEST_F(NodeTest, BeginsAnewOnceWhereAllItsLasersStampsJumpBack) {
  settings.node.scan_topics = "/front /rear";
  give_map(), give_wheels();
  link.transforms[{"base_link", "front"}] = link.transforms[{"base_link", "rear"}] =
      FakeLink::known(0.3, 0.0);
  scan(100, "front"), scan(100, "rear"), scan(500, "top");
  const std::size_t begun = localizer->starts.size();
  scan(10, "front"), scan(10, "rear"), scan(5, "top");
  EXPECT_EQ(localizer->starts.size(), begun + 1);
  EXPECT_THAT(link.poses, SizeIs(4));
}

TEST_F(NodeTest, TakesAGoodMapAfterOneThatCannotBeUsed) {
  is_map_refused = true;
  give_map(), give_laser();
  scan(10);
  EXPECT_THAT(link.poses, IsEmpty());
  is_map_refused = false;
  node().hear_map({"map", 0.5, 3, 2, {}, {100, 0, 0, 100, 0, 0}});
  scan(11);
  EXPECT_THAT(link.poses, SizeIs(1));
}

TEST_F(NodeTest, DoesNotWaitForeverForALaserThatNobodyPlaces) {
  settings.node.scan_topics = "/front /rear";
  give_map();
  link.transforms[{"base_link", "front"}] = FakeLink::known(0.3, 0.0);
  scan(10, "front");
  scan(11, "rear");
  EXPECT_THAT(link.poses, IsEmpty());
  link.steady += 5.0;
  node().tick();
  EXPECT_THAT(link.poses, SizeIs(1));
  EXPECT_THAT(config_seen.lasers, IsEmpty());
  EXPECT_THAT(diagnosed(), HasSubstr("where the laser \"rear\" sits"));
  // Nothing waits for it again.
  scan(12, "rear"), scan(13, "front");
  EXPECT_THAT(link.poses, SizeIs(2));
  // It comes later.
  link.transforms[{"base_link", "rear"}] = FakeLink::known(-0.3, 0.0);
  scan(14, "rear"), scan(15, "front");
  EXPECT_THAT(link.poses, SizeIs(4));
  EXPECT_THAT(config_seen.lasers, SizeIs(2));
}

TEST_F(NodeTest, KeepsTheOrderWhileAScanWaitsForItsWheels) {
  give_map(), give_laser();
  link.transforms[{"odom", "base_link"}] = {TransformAnswer::Kind::not_yet, {}, "it would lie in the future"};
  scan(10), scan(11);
  EXPECT_THAT(link.poses, IsEmpty());
  give_wheels();
  node().tick();
  ASSERT_THAT(link.poses, SizeIs(2));
  EXPECT_EQ(link.poses[0].stamp_ns, 10 * kTenth_ns);
}

TEST_F(NodeTest, GoesOnWithoutWheelsThatStayAwayAndSendsNoTf) {
  give_map(), give_laser(), give_wheels();
  scan(10);
  link.transforms[{"odom", "base_link"}] = {TransformAnswer::Kind::not_yet, {}, "it would lie in the future"};
  scan(11);
  link.steady += 0.3;
  node().tick();
  EXPECT_THAT(link.poses, SizeIs(2));
  EXPECT_THAT(link.sent_transforms, SizeIs(1));
  EXPECT_THAT(diagnosed(), HasSubstr("it would lie in the future"));
}

TEST_F(NodeTest, RefusesABadInitialPoseAndGoesOn) {
  give_map(), give_laser(), give_wheels();
  scan(10);
  PoseMessage bad{0, "odom", {}, {}};
  node().hear_initial_pose(bad);
  EXPECT_THAT(localizer->starts, SizeIs(1));
  EXPECT_THAT(diagnosed(), HasSubstr("initialpose: refused: "));
  bad.frame_id = "base";
  node().hear_initial_pose(bad);
  EXPECT_THAT(link.logs, testing::AllOf(Contains(HasSubstr("frame is \"odom\"")),
                                        Contains(HasSubstr("frame is \"base\""))));
  bad.frame_id = "map";
  node().hear_initial_pose(bad);
  EXPECT_THAT(localizer->starts, SizeIs(2));
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("refused")));
}

TEST_F(NodeTest, RefusesAnInitialPoseOffTheMap) {
  settings.has_initial_pose = false;
  settings.node.start = "wait";
  node().hear_initial_pose({0, "map", {480.0, 0.0}, {}});  // before there is one
  give_map(), give_laser();
  EXPECT_THAT(diagnosed(), HasSubstr("lies 479 m off the map"));
  scan(10);
  EXPECT_THAT(localizer->starts, IsEmpty());
  node().hear_initial_pose({0, "map", {1.0, 0.0}, {}});
  EXPECT_THAT(localizer->starts, SizeIs(1));
  EXPECT_FALSE(node().serve_set_map({"map", 0.5, 1, 1, {}, {100}}, {0, "map", {480.0, 0.0}, {}}).is_done);
  EXPECT_THAT(localizer->starts, SizeIs(1));
}

TEST_F(NodeTest, LooksEverywhereWhereItsParametersAreOffTheMap) {
  settings.node.initial_pose_x = 480.0;
  node().hear_map({"floor", 0.5, 2, 2, {}, {100, 0, 0, 100}});
  give_laser();
  EXPECT_THAT(link.logs, testing::AllOf(Contains("looking for the robot on the whole map"),
                                        Contains(HasSubstr("its frame is \"floor\""))));
  scan(10);
  EXPECT_THAT(localizer->starts, IsEmpty());
  EXPECT_THAT(localizer->searches, SizeIs(1));
}

TEST_F(NodeTest, ForgetsAnEarlyPoseThatItIsToldToSearchFor) {
  node().hear_initial_pose({0, "map", {1.0, 0.0}, {}});
  node().serve_global_localization();
  give_map(), give_laser();
  scan(10);
  EXPECT_THAT(localizer->starts, IsEmpty());
  EXPECT_THAT(localizer->searches, SizeIs(1));
}

TEST_F(NodeTest, TakesTheLatestWordThatComesBeforeTheMap) {
  node().serve_global_localization();
  node().hear_initial_pose({0, "map", {1.0, 0.0}, {}});
  give_map(), give_laser();
  scan(10);
  ASSERT_THAT(localizer->starts, SizeIs(1));
  EXPECT_EQ(localizer->starts[0].x_m, 1.0);
}

TEST_F(NodeTest, BeginsOnceWhereItsFirstMapIsSet) {
  give_laser();
  EXPECT_TRUE(node().serve_set_map({"map", 0.5, 1, 1, {}, {100}}, {0, "map", {7.0, 0.0}, {}}).is_done);
  scan(10);
  ASSERT_THAT(localizer->starts, SizeIs(1));
  EXPECT_EQ(localizer->starts[0].x_m, 7.0);
  EXPECT_THAT(localizer->searches, IsEmpty());
}

TEST_F(NodeTest, SaysThatAMapCannotBeRead) {
  node().hear_map({"map", 0.5, 2, 2, {}, {100}});
  EXPECT_THAT(diagnosed(), HasSubstr("map: "));
  EXPECT_THAT(link.logs, Contains(HasSubstr("map: ")));
}

TEST_F(NodeTest, SendsNoTransformThatWouldCloseALoop) {
  give_map(), give_laser(), give_wheels();
  const auto hear = [&](const char* parent, const char* child, bool is_static = false) {
    node().hear_transform_of_other({0, parent, child, {}}, "/player", is_static);
  };
  hear("base_link", "laser"), hear("odom", "base_link"), hear("world", "map");
  scan(10);
  EXPECT_THAT(link.sent_transforms, SizeIs(1));
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("/player")));
  hear("/odom", "/map");
  scan(11);
  EXPECT_THAT(link.poses, SizeIs(2));
  EXPECT_THAT(link.sent_transforms, SizeIs(1));
  EXPECT_THAT(diagnosed(), HasSubstr("/player tells \"map\" below \"odom\""));
  link.steady += 11.0;  // it has ended
  scan(12);
  EXPECT_THAT(link.sent_transforms, SizeIs(2));
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("/player")));
  hear("odom", "map", true);
  link.steady += 1000.0;
  scan(13);
  EXPECT_THAT(link.sent_transforms, SizeIs(2));
  EXPECT_THAT(diagnosed(), HasSubstr("static"));
  node().hear_new_master();
  scan(14);
  EXPECT_THAT(link.sent_transforms, SizeIs(3));
}

TEST_F(NodeTest, SaysWhoTellsItsTransformAsWell) {
  give_map(), give_laser(), give_wheels();
  node().hear_transform_of_other({0, "map", "odom", {}}, "/amcl", false);
  scan(10);
  EXPECT_THAT(link.sent_transforms, SizeIs(1));
  EXPECT_THAT(diagnosed(), HasSubstr("/amcl tells \"odom\" below \"map\""));
}

TEST_F(NodeTest, SaysNothingOfTheTreeWhereItTellsNoTf) {
  settings.node.tf_broadcast = false;
  give_map(), give_laser(), give_wheels();
  node().hear_transform_of_other({0, "map", "odom", {}}, "/amcl", false);
  scan(10);
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("/amcl")));
}

TEST_F(NodeTest, LogsTheMapAndWhenTheRobotIsFoundAndLost) {
  give_map(), give_laser(), give_wheels();
  scan(10), scan(11);
  EXPECT_THAT(link.logs, testing::ElementsAre("map: 2 x 2 cells of 0.5 m", HasSubstr("starting at"),
                                              "ok at x 3.000 m, y 4.000 m, 28.6 degrees"));
  localizer->after_start_at = {{.status = Status::lost}};
  scan(12), scan(13);
  EXPECT_EQ(link.logs.back(), "lost: it was told so");
  EXPECT_THAT(link.logs, SizeIs(4));
  node().serve_global_localization();
  scan(14), scan(15);
  EXPECT_EQ(link.logs.back(), "looking for the robot on the whole map");
  EXPECT_THAT(link.logs, SizeIs(5));
}

TEST_F(NodeTest, SearchesWhenItIsAskedTo) {
  give_map(), give_laser(), give_wheels();
  scan(10);
  EXPECT_TRUE(node().serve_global_localization().is_done);
  scan(11);
  EXPECT_THAT(localizer->searches, SizeIs(1));
  EXPECT_THAT(link.poses, SizeIs(1));  // none while it is not known which place it is
  EXPECT_THAT(link.sent_transforms, SizeIs(1));
  EXPECT_THAT(link.places.back().poses, SizeIs(2));
  EXPECT_FALSE(node().serve_save_pose().is_done);
}

TEST_F(NodeTest, SearchesFromTheBeginningWithoutAnInitialPose) {
  settings.has_initial_pose = false;
  give_map(), give_laser();
  scan(10);
  EXPECT_THAT(localizer->searches, SizeIs(1));
}

TEST_F(NodeTest, TakesAnInitialPoseThatComesBeforeTheMap) {
  node().hear_initial_pose({0, "map", {7.0, 0.0}, {}});
  give_map(), give_laser();
  scan(10);
  ASSERT_THAT(localizer->starts, SizeIs(1));
  EXPECT_EQ(localizer->starts[0].x_m, 7.0);
}

TEST_F(NodeTest, SurvivesStampsOfEveryKindAndSaysSo) {
  give_map(), give_laser(), give_wheels();
  link.now = 10 * kTenth_ns;
  scan(10), scan(10);
  EXPECT_THAT(diagnosed(), HasSubstr("has the stamp of the one before"));
  scan(9);
  EXPECT_THAT(diagnosed(), HasSubstr("stamped earlier"));
  EXPECT_THAT(link.poses, SizeIs(1));
  scan(9000);
  EXPECT_THAT(diagnosed(), HasSubstr("ahead of now"));
  scan(5);
  EXPECT_THAT(diagnosed(), HasSubstr("jumped back"));
  EXPECT_THAT(link.poses, SizeIs(3));
  // It began anew where it was.
  EXPECT_EQ(localizer->starts.back().x_m, 3.0);
}

TEST_F(NodeTest, SaysWhatIsMissing) {
  scan(10);
  EXPECT_THAT(diagnosed(), HasSubstr("no map yet"));
  give_map(), give_laser();
  link.steady += 5.0;
  EXPECT_THAT(diagnosed(), HasSubstr("no scan for"));
  scan(11);
  EXPECT_THAT(link.poses, SizeIs(1));
  EXPECT_THAT(diagnosed(), testing::Not(HasSubstr("no map yet")));
  scan(12, "other_laser");
  EXPECT_THAT(diagnosed(), HasSubstr("\"other_laser\" are passed over"));
}

TEST_F(NodeTest, KeepsItsPoseOverAnotherMapAndPassesTheSameOver) {
  give_map(), give_laser(), give_wheels();
  scan(10);
  const FakeLocalizer* first = localizer;
  give_map();
  EXPECT_EQ(localizer, first);
  node().hear_map({"map", 0.5, 1, 1, {}, {100}});
  ASSERT_THAT(localizer->starts, SizeIs(1));
  EXPECT_EQ(localizer->starts[0].x_m, 3.0);
}

TEST_F(NodeTest, SendsAMapThatCameFromAFileAndHearsNoOther) {
  settings.node.map_file = "room.yaml";
  ASSERT_TRUE(node().set_map(FloorPlan{.walls = {{{0.0, 0.0}, {4.0, 0.0}}}}, {"room.yaml", 1}));
  ASSERT_THAT(link.maps, SizeIs(1));
  EXPECT_THAT(link.maps[0].percent, Contains(100));
  EXPECT_THAT(link.logs, Contains("map: a floor plan of 1 line"));
  give_map();
  give_laser();
  scan(10);
  EXPECT_THAT(link.poses, SizeIs(1));
  EXPECT_THAT(link.maps, SizeIs(1));
}

TEST_F(NodeTest, SetsMapAndPoseTogetherOrNeither) {
  give_map(), give_laser(), give_wheels();
  scan(10);
  PoseMessage pose{0, "map", {7.0, 0.0}, {}};
  EXPECT_FALSE(node().serve_set_map({"map", 0.5, 2, 2, {}, {100}}, pose).is_done);
  EXPECT_TRUE(node().serve_set_map({"map", 0.5, 1, 1, {}, {100}}, pose).is_done);
  EXPECT_EQ(localizer->starts.back().x_m, 7.0);
  pose.pose.x_m = std::nan("");
  EXPECT_FALSE(node().serve_set_map({"map", 0.5, 1, 1, {}, {0}}, pose).is_done);
}

TEST_F(NodeTest, KeepsThePoseForTheNextOneOfItsName) {
  give_map(), give_laser(), give_wheels();
  EXPECT_FALSE(node().serve_save_pose().is_done);
  scan(10);
  EXPECT_TRUE(node().serve_save_pose().is_done);
  EXPECT_EQ(link.kept.at("initial_pose_y"), 4.0);
}

}  // namespace
}  // namespace beaconless::ros1
