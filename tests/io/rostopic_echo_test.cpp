// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rostopic_echo.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr const char* kRos1 = R"(header: 
  seq: 12
  stamp: 
    secs: 1411657682
    nsecs:  42859000
  frame_id: "laser"
angle_min: -1.57079637051
angle_max: 1.57079637051
angle_increment: 0.78539818525314331
time_increment: 0.0
scan_time: 0.10000000149011612
range_min: 0.10000000149011612
range_max: 30.0
ranges: [nan, inf, 1.0, 0.050000000745058, 2.5]
intensities: []
---
)";

constexpr const char* kRos2 = R"(header:
  stamp:
    sec: 1411657682
    nanosec: 42859000
  frame_id: laser
angle_min: -1.5707963705062866
angle_max: 1.5707963705062866
angle_increment: 0.7853981852531433
time_increment: 0.0
scan_time: 0.10000000149011612
range_min: 0.10000000149011612
range_max: 30.0
ranges:
- .nan
- .inf
- 1.0
- 0.05000000074505806
- 2.5
intensities: []
---
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(RostopicEcho, Ros1AndRos2GiveTheSameScan) {
  const TempFolder folder;
  const Pass ros1 = pass_over(folder.write("1", kRos1));
  const Pass ros2 = pass_over(folder.write("2", kRos2));
  ASSERT_THAT(ros1.scans, SizeIs(1));
  ASSERT_THAT(ros2.scans, SizeIs(1));
  EXPECT_EQ(ros1.scans[0], ros2.scans[0]);
  EXPECT_EQ(ros1.scans[0].stamp().ns, 1'411'657'682'042'859'000);
  EXPECT_EQ(ros1.scans[0].frame_id(), "laser");
  EXPECT_THAT(ros1.scans[0].beams(),
              testing::ElementsAre(Beam::invalid, Beam::no_return, Beam::hit, Beam::too_close, Beam::hit));
  EXPECT_THAT(ros1.problems, SizeIs(0));
}

TEST(RostopicEcho, WrittenScansComeBackBitForBit) {
  const TempFolder folder;
  const auto scans = sample_scans(4, 200);
  ASSERT_TRUE(io::write_rostopic_echo(folder.path("echo"), scans));
  const Pass pass = pass_over(folder.path("echo"));
  ASSERT_THAT(pass.scans, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(pass.scans[i], Scan::make(scans[i]).value());
}

TEST(RostopicEcho, FlowStyleOfRos2IsReadToo) {
  const TempFolder folder;
  const std::string flow = with(kRos2, "\n- .nan\n- .inf\n- 1.0\n- 0.05000000074505806\n- 2.5",
                                " [.nan, .inf, 1.0,\n  0.05000000074505806, 2.5]");
  const Pass pass = pass_over(folder.write("flow", flow));
  ASSERT_THAT(pass.scans, SizeIs(1)) << flow;
  EXPECT_EQ(pass.scans[0], pass_over(folder.write("list", kRos2)).scans.at(0));
}

TEST(RostopicEcho, AbridgedArraysAreRefusedWithTheRemedy) {
  const TempFolder folder;
  const Pass list = pass_over(folder.write("a", with(kRos2, "- 2.5", "- '...'")));
  ASSERT_TRUE(list.error);
  EXPECT_THAT(list.error->remedy, HasSubstr("--full-length"));
  const Pass flow = pass_over(folder.write("b", with(kRos2, "- .nan\n- .inf\n- 1.0\n", "- 1.0\n- '...'\n")));
  EXPECT_TRUE(flow.error);
  EXPECT_THAT(flow.error->what, HasSubstr("no more than 128"));
  const Pass sequence =
      pass_over(folder.write("d", with(kRos2, "\n- .nan\n- .inf\n- 1.0\n- 0.05000000074505806\n- 2.5",
                                       " '<sequence type: float, length: 5>'")));
  ASSERT_TRUE(sequence.error);
  EXPECT_THAT(sequence.error->remedy, HasSubstr("--no-arr"));
  const Pass left_out = pass_over(folder.write(
      "c", with(kRos1, "[nan, inf, 1.0, 0.050000000745058, 2.5]", "\"<array type: float32, length: 5>\"")));
  ASSERT_TRUE(left_out.error);
  EXPECT_THAT(left_out.error->remedy, HasSubstr("--noarr"));
}

TEST(RostopicEcho, DamagedMessagesAreNamedAndPassedOver) {
  const TempFolder folder;
  const std::string whole(kRos1);
  const std::string path =
      folder.write("echo", whole + with(whole, "secs: 1411657682", "secs: never") +
                               with(whole, "nsecs:  42859000", "nsecs: 4285900000") +
                               with(whole, "1.0, 0.05", "1.0, x, 0.05") +
                               with(whole, "angle_increment: 0.78", "angle_increment: x0.78") +
                               with(whole, "range_max: 30.0\n", "") + with(whole, "2.5]", "2.5") + whole);
  const Pass pass = pass_over(path);
  EXPECT_THAT(pass.scans, SizeIs(2));
  ASSERT_THAT(pass.problems, SizeIs(6 + 1));  // and one for the stamps, which repeat
  EXPECT_THAT(pass.problems[1].where, testing::StartsWith(path + ":"));
  EXPECT_THAT(pass.problems.back().what, HasSubstr("1 scan stamps repeat"));
}

TEST(RostopicEcho, ATextThatEndsWithinAMessageLosesOnlyThat) {
  const TempFolder folder;
  const std::string whole(kRos2);
  for (std::size_t cut = 1; cut + 4 < whole.size(); ++cut) {
    const Pass pass = pass_over(folder.write("echo", whole + whole.substr(0, cut)));
    // The second message is there only when its last array is: the closing --- may be missing.
    const bool is_whole = cut >= whole.find("---") - 1;
    EXPECT_THAT(pass.scans, SizeIs(is_whole ? 2 : 1)) << cut;
  }
}

TEST(RostopicEcho, AListWithoutItsEndIsNotWhole) {
  const TempFolder folder;
  const std::string whole =
      with(kRos2, "intensities: []", "intensities:\n- 10.5\n- 1.5\n- 1.5\n- 1.5\n- 47.5");
  const Pass both = pass_over(folder.write("echo", whole + whole));
  ASSERT_THAT(both.scans, SizeIs(2));
  for (const char* cut : {"7.5\n---\n", "---\n"})
    EXPECT_THAT(pass_over(folder.write("echo", whole + whole.substr(0, whole.rfind(cut)))).scans, SizeIs(1));
}

TEST(RostopicEcho, OdometryAndPoses) {
  const TempFolder folder;
  const std::string head = "header: \n  stamp: \n    secs: 5\n    nsecs: 7\n  frame_id: \"odom\"\n";
  const std::string at = "position: \n";
  const std::string pose =
      "    position: \n      x: 1.0\n      y: 2.0\n      z: 0.0\n    orientation: \n      x: 0.0\n      y: "
      "0.0\n"
      "      z: 1.0\n      w: 1.0\n";
  const std::string covariance = "  covariance: [1.0, 0.0]\n";
  const std::string path =
      folder.write("echo", head + "child_frame_id: \"base\"\npose: \n  pose: \n" + pose + covariance +
                               "twist: \n  twist: \n    linear: \n      x: 0.5\n      y: 0.0\n      z: 0.0\n "
                               "   angular: \n      x: "
                               "0.0\n      y: 0.0\n      z: 0.25\n" +
                               covariance + "---\n" + head + "pose: \n  pose: \n" + pose + covariance +
                               "---\n" + head + "pose: \n" + pose + "---\n");
  const Pass pass = pass_over(path);
  ASSERT_FALSE(pass.error) << *pass.error;
  ASSERT_THAT(pass.events, SizeIs(3));
  EXPECT_EQ(pass.odometry.at(0).stamp.ns, 5'000'000'007);
  EXPECT_NEAR(pass.odometry.at(0).odom_from_base.theta_rad, kPi / 2, 1e-12);
  EXPECT_EQ(pass.odometry.at(0).twist_per_s, (Twist2{0.5, 0.0, 0.25}));
  EXPECT_EQ(pass.references.at(0).map_from_base, pass.odometry.at(0).odom_from_base);
  EXPECT_EQ(pass.references.at(1).map_from_base, pass.odometry.at(0).odom_from_base);
  const std::string whole = folder.read("echo");
  for (const std::size_t cut : cuts(whole.size())) {
    const Pass some = pass_over(folder.write("cut", whole.substr(0, cut)));
    ASSERT_LE(some.events.size(), pass.events.size());
    EXPECT_TRUE(std::equal(some.events.begin(), some.events.end(), pass.events.begin())) << cut;
  }
}

}  // namespace
}  // namespace beaconless
