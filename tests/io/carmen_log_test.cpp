// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/carmen_line.hpp"

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

std::string ones(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += " 1";
  return text;
}

std::string flaser(int beams, const std::string& stamp = "5.5 host 6.5") {
  return "FLASER " + std::to_string(beams) + ones(beams) + " 1 2 0.5 3 2 0.5 " + stamp + "\n";
}

TEST(CarmenLine, BeamCountTellsTheSector) {
  struct Case {
    int beams;
    double first_deg, step_deg;
  };
  for (const Case c : {Case{180, -90, 1}, Case{181, -90, 1}, Case{360, -90, 0.5}, Case{361, -90, 0.5},
                       Case{401, -50, 0.25}, Case{721, -90, 0.25}}) {
    const auto scan = io::parse_carmen_scan(flaser(c.beams), {});
    ASSERT_TRUE(scan) << scan.error();
    EXPECT_FLOAT_EQ(scan->raw.angle_min_rad, static_cast<float>(radians(c.first_deg))) << c.beams;
    EXPECT_FLOAT_EQ(scan->raw.angle_increment_rad, static_cast<float>(radians(c.step_deg))) << c.beams;
  }
}

TEST(CarmenLine, FrameNamesSurviveAsOneWord) {
  for (const std::string name : {"", "laser", "/base laser", "%", "a%20b", "tab\there", "läser", "%4"})
    EXPECT_EQ(io::from_carmen_word(io::to_carmen_word(name)), name);
  EXPECT_EQ(io::to_carmen_word("a b"), "a%20b");
}

TEST(CarmenLog, FlaserGivesRobotPoseThenScan) {
  const TempFolder folder;
  const Pass pass = pass_over(folder.write("log", "# a comment\n" + flaser(181)));
  ASSERT_FALSE(pass.error) << *pass.error;
  ASSERT_THAT(pass.events, SizeIs(2));
  const auto& pose = std::get<ReferencePose>(pass.events[0]);
  const auto& scan = std::get<Scan>(pass.events[1]);
  EXPECT_EQ(pose.stamp.ns, 5'500'000'000);
  EXPECT_EQ(scan.stamp(), pose.stamp);
  EXPECT_EQ(pose.map_from_base, (Pose2{3, 2, 0.5}));
  ASSERT_TRUE(pose.base_from_laser);
  EXPECT_NEAR(pose.base_from_laser->x_m, -2.0 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(pose.base_from_laser->y_m, 2.0 * std::sin(0.5), 1e-12);
  EXPECT_EQ(pose.source, "FLASER");
  EXPECT_EQ(scan.range_max_m(), 81.0);
}

TEST(CarmenLog, ErrorCodesOfSickScannersAreNoReturns) {
  const TempFolder folder;
  const Pass pass = pass_over(folder.write("log", "FLASER 3 81.91 81.83 80.99 0 0 0 0 0 0 1 h 1\n"));
  ASSERT_THAT(pass.scans, SizeIs(1));
  EXPECT_THAT(pass.scans[0].beams(), testing::ElementsAre(Beam::no_return, Beam::no_return, Beam::hit));
}

TEST(CarmenLog, ParamLinesLimitTheRange) {
  const TempFolder folder;
  const Pass pass =
      pass_over(folder.write("log", "PARAM robot_front_laser_max 50 1 h 1\n" + flaser(181) +
                                        "PARAM robot_front_laser_max nan 1 h 1\n" + flaser(181) +
                                        "PARAM robot_front_laser_max 7\n" + flaser(181)));
  ASSERT_THAT(pass.scans, SizeIs(3));
  EXPECT_EQ(pass.scans[0].range_max_m(), 50.0);
  EXPECT_EQ(pass.scans[1].range_max_m(), 50.0);
  EXPECT_EQ(pass.scans[2].range_max_m(), 7.0);
}

TEST(CarmenLog, RobotlaserAndOthers) {
  const TempFolder folder;
  const Pass pass = pass_over(
      folder.write("log",
                   "ODOM 1 2 3 0.4 0.5 0 7.25 host 8\n"
                   "VERTEX2 0 0 0 0\nEDGE2 whatever\nNEFF 1 2\nSYNC x\n\n"
                   "ROBOTLASER1 0 -1.5 3 0.25 20 0.01 1 3 1 2 3 3 10 20 30 1 2 0 1 2 0 9 9 9 9 9 7.5 host 1\n"
                   "TRUEPOS 4 5 6 0 0 0 7.75 host 1\n"
                   "ODOM 1 2 3 0 0 0 8 host 8\n"));
  ASSERT_THAT(pass.events, SizeIs(5));
  EXPECT_EQ(pass.odometry[0], (Odometry{Stamp{7'250'000'000}, {1, 2, 3}, Twist2{0.4, 0, 0.5}, "ODOM"}));
  EXPECT_FALSE(pass.odometry[1].twist_per_s);
  EXPECT_EQ(pass.references[0].source, "ROBOTLASER1");
  EXPECT_FALSE(pass.references[0].base_from_laser) << "laser and robot pose are the same: nothing is told";
  EXPECT_EQ(pass.references[1], (ReferencePose{Stamp{7'750'000'000}, {4, 5, 6}, std::nullopt, "TRUEPOS"}));
  EXPECT_THAT(pass.scans[0].intensities(), testing::ElementsAre(10.0F, 20.0F, 30.0F));
  EXPECT_THAT(pass.problems, SizeIs(0));
}

TEST(CarmenLog, RawlaserHasNoPose) {
  const TempFolder folder;
  const Pass pass = pass_over(folder.write("log", "RAWLASER1 0 -1.5 3 0.25 20 0.01 0 2 1 2 0 7.5 host 1\n"));
  EXPECT_THAT(pass.events, SizeIs(1));
  EXPECT_THAT(pass.scans, SizeIs(1));
}

TEST(CarmenLog, DamagedLinesAreNamedAndPassedOver) {
  const TempFolder folder;
  const std::string path =
      folder.write("log", flaser(5) +                               // 1
                              "FLASER 4294967295 1 2 3\n"           // 2: promises too much
                              "FLASER 99999999999999999999999\n"    // 3
                              "FLASER -5 1\n"                       // 4
                              "FLASER\n"                            // 5
                              + flaser(5, "nan h 1") +              // 6
                              flaser(5, "") +                       // 7
                              "FLASER 2 1 x 0 0 0 0 0 0 1 h 1\n"    // 8
                              "FLASER 2 1 1 1 0 0 0 0 0 0 1 h 1\n"  // 9: a range too many
                              "FLASER 2 1 1 nan 0 0 0 0 0 1 h 1\n"  // 10
                              "ODOM 1 2 inf 0 0 0 1 h 1\n"          // 11
                              "ODOM\n"                              // 12
                              "FLASER 0 0 0 0 0 0 0 1 h 1\n"        // 13: no beams
                              + flaser(5, "6 h 6"));                // 14
  const Pass pass = pass_over(path);
  EXPECT_THAT(pass.scans, SizeIs(2));
  ASSERT_THAT(pass.problems, SizeIs(12));
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(pass.problems[i].where, path + ":" + std::to_string(i + 2));
  EXPECT_THAT(pass.problems[0].what, HasSubstr("4294967295"));
  EXPECT_THAT(pass.problems[4].what, HasSubstr("nan"));
}

TEST(CarmenLog, ALastLineThatLostItsEndIsReadOnlyWhenItIsWhole) {
  const TempFolder folder;
  const std::string line = "ODOM 1.5 2.5 0.5 0 0 0 10.25 host 10.5";
  for (std::size_t size = 5; size < line.size(); ++size) {
    const Pass pass = pass_over(folder.write("log", line + "\n" + line.substr(0, size)));
    for (const Odometry& odometry : pass.odometry) EXPECT_EQ(odometry, pass.odometry.front()) << size;
    EXPECT_EQ(pass.odometry.size() + pass.problems.size(), 2U) << size;
  }
  EXPECT_THAT(pass_over(folder.write("log", line)).odometry, SizeIs(1));
}

TEST(CarmenLog, StampsOutOfOrderAreReportedOnce) {
  const TempFolder folder;
  const std::string path = folder.write(
      "log", flaser(5, "1 h 1") + flaser(5, "1 h 1") + flaser(5, "1 h 1") + flaser(5, "0.5 h 1"));
  const Pass pass = pass_over(path);
  EXPECT_THAT(pass.scans, SizeIs(4));
  ASSERT_THAT(pass.problems, SizeIs(1));
  EXPECT_EQ(pass.problems[0].where, path + ":2");
  EXPECT_THAT(pass.problems[0].what, HasSubstr("2 scan stamps repeat and 1 run backwards"));
}

TEST(CarmenLog, SeveralScanKeywordsNeedAChoice) {
  const TempFolder folder;
  const std::string path = folder.write("log", flaser(5) + flaser(5) + "R" + flaser(5).substr(1));
  const Pass undecided = pass_over(path);
  ASSERT_TRUE(undecided.error);
  EXPECT_THAT(to_string(*undecided.error), HasSubstr("FLASER (2 scans), RLASER (1 scans)"));
  EXPECT_THAT(pass_over(path, {.topic = "RLASER"}).scans, SizeIs(1));
  const Pass wrong = pass_over(path, {.topic = "RLASERS"});
  ASSERT_TRUE(wrong.error);
  EXPECT_THAT(wrong.error->remedy, HasSubstr("RLASER"));
}

TEST(CarmenLog, ALineWithoutEndIsPassedOver) {
  const TempFolder folder;
  const std::string path =
      folder.write("log", flaser(5) + std::string(9U << 20U, '1') + "\n" + flaser(5, "7 h 7"));
  const Pass pass = pass_over(path);
  EXPECT_THAT(pass.scans, SizeIs(2));
  ASSERT_THAT(pass.problems, SizeIs(1));
  EXPECT_EQ(pass.problems[0].where, path + ":2");
}

TEST(CarmenLog, WindowsLineEndsAndNoLastLineEnd) {
  const TempFolder folder;
  std::string text = flaser(5);
  text.insert(text.size() - 1, "\r");
  EXPECT_THAT(pass_over(folder.write("a", text + flaser(5, "9 h 9"))).scans, SizeIs(2));
  EXPECT_THAT(pass_over(folder.write("b", text.substr(0, text.size() - 2))).scans, SizeIs(1));
}

}  // namespace
}  // namespace beaconless
