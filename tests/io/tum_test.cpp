// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/tum.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Reads a file and gathers its problems.
struct Read {
  std::vector<Problem> problems;
  Result<Trajectory> trajectory;

  explicit Read(const std::string& path)
      : trajectory(read_tum(path, [this](const Problem& problem) { problems.push_back(problem); })) {}
};

TEST(Tum, ReadsStampsToTheNanosecondAndHeadings) {
  const TempFolder folder;
  const Read read(folder.write("a.tum",
                               "# t x y z qx qy qz qw\n\n"
                               "1411657682.042859001 1.5 -2 9 0 0 0 1\r\n"
                               "  1411657683\t1 2 0 0 0 0.70710678118654752 0.70710678118654752  \n"
                               "1411657684 1 2 0 0 0 -2 0"));
  ASSERT_TRUE(read.trajectory) << read.trajectory.error();
  EXPECT_THAT(read.problems, IsEmpty());
  const Trajectory& t = *read.trajectory;
  ASSERT_EQ(t.size(), 3U);
  EXPECT_EQ(t[0].stamp.ns, 1411657682042859001);
  EXPECT_EQ(t[0].pose, (Pose2{1.5, -2.0, 0.0}));
  EXPECT_NEAR(t[1].pose.theta_rad, kPi / 2.0, 1e-15);
  EXPECT_EQ(std::abs(t[2].pose.theta_rad), kPi);
}

// Recipe: the yaw of a rotation is the heading of the x axis it turns, seen from above.
TEST(Tum, YawIsTheHeadingOfTheTurnedXAxisForAnyQuaternion) {
  const TempFolder folder;
  Rng rng(1);
  for (int i = 0; i < 300; ++i) {
    const double scale = std::pow(10.0, rng.uniform(-4.0, 150.0));
    const double x = scale * rng.normal(), y = scale * rng.normal(), z = scale * rng.normal(),
                 w = scale * rng.normal();
    char line[300];
    std::snprintf(line, sizeof line, "1 0 0 0 %.17g %.17g %.17g %.17g\n", x, y, z, w);
    const double n = std::hypot(std::hypot(x, y), std::hypot(z, w));
    const double a = x / n, b = y / n, c = z / n, d = w / n;
    const double axis_x = d * d + a * a - b * b - c * c;
    const double axis_y = 2.0 * (a * b + d * c);
    if (std::hypot(axis_x, axis_y) < 1e-3) continue;  // looking straight up
    const auto read = read_tum(folder.write("a.tum", line));
    ASSERT_TRUE(read) << line;
    EXPECT_NEAR(wrap_angle((*read)[0].pose.theta_rad - std::atan2(axis_y, axis_x)), 0.0, 1e-11) << line;
  }
}

TEST(Tum, BadLinesAreToldByNumberAndPassedOver) {
  const TempFolder folder;
  const Read read(folder.write("a.tum",
                               "1 1 0 0 0 0 0 1\n"
                               "2 1 0 0 0 0 1\n"
                               "3 1 0 0 0 0 0 1 9\n"
                               "four 1 0 0 0 0 0 1\n"
                               "5 nan 0 0 0 0 0 1\n"
                               "6 1 inf 0 0 0 0 1\n"
                               "7 1 0 0 0 0 0 0\n"
                               "8 1e300 0 0 0 0 0 1\n"
                               "9,1,0,0,0,0,0,1\n"
                               "10 1m 0 0 0 0 0 1\n"
                               "11 1 0 0 0 0 0 1\n"));
  ASSERT_TRUE(read.trajectory);
  EXPECT_EQ(read.trajectory->size(), 2U);
  ASSERT_EQ(read.problems.size(), 9U);
  for (std::size_t i = 0; i < read.problems.size(); ++i)
    EXPECT_EQ(read.problems[i].where, folder.path("a.tum") + ":" + std::to_string(i + 2));
  EXPECT_THAT(read.problems[0].what, HasSubstr("7 words"));
  EXPECT_THAT(read.problems[2].what, HasSubstr("\"four\""));
  EXPECT_THAT(read.problems[3].what, HasSubstr("\"nan\""));
  EXPECT_THAT(read.problems[5].what, HasSubstr("no length"));
}

TEST(Tum, StampsThatRunBackwardsAreToldAndSorted) {
  const TempFolder folder;
  const Read read(folder.write("a.tum", "2 2 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n"));
  ASSERT_EQ(read.problems.size(), 1U);
  EXPECT_THAT(read.problems[0].where, HasSubstr("a.tum:2"));
  ASSERT_EQ(read.trajectory->size(), 3U);
  EXPECT_EQ((*read.trajectory)[0].pose.x_m, 1.0);
}

TEST(Tum, AFileWithoutAPoseIsAnError) {
  const TempFolder folder;
  for (const char* text : {"", "\n\n", "# only words\n", "not a pose at all\n"})
    EXPECT_THAT(read_tum(folder.write("a.tum", text)).error().what, HasSubstr("no pose")) << text;
  EXPECT_THAT(read_tum(folder.path("gone.tum")).error().what, HasSubstr("no such file"));
  EXPECT_THAT(read_tum(folder.path("")).error().what, HasSubstr("directory"));
}

// Nine decimals: half a nanometre in position; the half angle's sine and cosine each good to 0.5e-9, so the
// heading to 2 sqrt(2) 0.5e-9.
TEST(Tum, WhatIsWrittenReadsBackToItsDecimals) {
  const TempFolder folder;
  Rng rng(2);
  std::vector<StampedPose> poses;
  for (int i = 0; i < 500; ++i)
    poses.push_back(
        {Stamp{1411657682042859001 + i}, {rng.normal(100.0), rng.normal(100.0), rng.uniform(-kPi, kPi)}});
  const Trajectory written(poses);
  ASSERT_TRUE(write_tum(folder.path("a.tum"), written));
  const Trajectory read = read_tum(folder.path("a.tum")).value();
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, written[i].stamp);
    EXPECT_NEAR(read[i].pose.x_m, written[i].pose.x_m, 0.51e-9);
    EXPECT_NEAR(read[i].pose.y_m, written[i].pose.y_m, 0.51e-9);
    EXPECT_LE(heading_difference_rad(read[i].pose, written[i].pose), 1.5e-9);
  }
}

TEST(Tum, WriterWritesEstimatesAndSaysWhenItCannot) {
  const TempFolder folder;
  TumWriter writer(folder.path("a.tum"));
  writer.write(PoseEstimate{.stamp = Stamp{5}, .map_from_base = {1.0, 2.0, 0.0}});
  EXPECT_TRUE(writer.good());
  EXPECT_TRUE(writer.finish());
  EXPECT_EQ(folder.read("a.tum"), "0.000000005 1.000000000 2.000000000 0 0 0 0.000000000 1.000000000\n");
  TumWriter lost(folder.path("gone/a.tum"));
  EXPECT_FALSE(lost.good());
  EXPECT_THAT(lost.finish().error().where, HasSubstr("gone/a.tum"));
}

TEST(Tum, SurvivesDamage) {
  const TempFolder folder;
  const std::string whole = "1.25 1 2 0 0 0 0.5 0.5\n2.5 1e1 -2 0 0 0 1 0\n";
  for (std::size_t size = 0; size < whole.size(); ++size)
    (void)read_tum(folder.write("a.tum", whole.substr(0, size)));
  Rng rng(3);
  for (int i = 0; i < 5000; ++i) {
    std::string changed = whole;
    for (int k = 0; k <= i % 4; ++k) changed[rng.bits() % changed.size()] = static_cast<char>(rng.bits());
    const auto trajectory = read_tum(folder.write("a.tum", changed));
    if (!trajectory) continue;
    for (const StampedPose& stamped : *trajectory) EXPECT_TRUE(stamped.pose.is_finite()) << changed;
  }
}

TEST(Tum, ReadsTheRecordedReferences) {
  const std::string path = recorded("jarvis/jarvis_circular_gt_plan_frame.tum");
  if (path.empty()) GTEST_SKIP() << "the recorded references are not here (BEACONLESS_DATA)";
  const Read read(path);
  ASSERT_TRUE(read.trajectory);
  EXPECT_THAT(read.problems, IsEmpty());
  EXPECT_EQ(read.trajectory->front().stamp.ns, 1411657682042859000);
  EXPECT_NEAR(read.trajectory->length_m(), 11.4, 0.6);  // "11.4 m" of the data's description, and the jitter
}

}  // namespace
}  // namespace beaconless::io
