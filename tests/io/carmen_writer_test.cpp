// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/carmen_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using testing::SizeIs;

TEST(CarmenWriter, ScansComeBackBitForBit) {
  const TempFolder folder;
  const auto scans = sample_scans(5, 1081);
  for (const std::string name : {"log", "log.gz"}) {
    io::CarmenWriter writer(folder.path(name), "two\nlines");
    for (const RawScan& scan : scans) writer.write(scan);
    ASSERT_TRUE(writer.close());
    const Pass pass = pass_over(folder.path(name));
    ASSERT_FALSE(pass.error) << *pass.error;
    ASSERT_THAT(pass.events, SizeIs(5));
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(pass.scans[i], Scan::make(scans[i]).value());
  }
  EXPECT_LT(folder.read("log.gz").size(), folder.read("log").size());
  EXPECT_EQ(folder.read("log").substr(0, 9), "# CARMEN ");
}

TEST(CarmenWriter, ScansBehindTheGateComeBackBitForBit) {
  const TempFolder folder;
  auto raws = sample_scans(3, 1081);
  raws[1].frame_id = "other frame";
  raws[1].time_increment_s = 0.0F;
  raws[2].range_max_m = 0.0F;  // not told
  raws[2].range_min_m = 0.0F;
  std::vector<Scan> scans;
  for (const RawScan& raw : raws) scans.push_back(Scan::make(raw).value());
  io::CarmenWriter writer(folder.path("log"));
  const Pose2 base_from_laser{0.7, 0.1, -0.2};
  for (const Scan& scan : scans) writer.write(scan, {3.0, -4.0, 2.5}, base_from_laser);
  ASSERT_TRUE(writer.close());
  const Pass pass = pass_over(folder.path("log"));
  ASSERT_THAT(pass.events, SizeIs(6));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pass.scans[i], scans[i]) << i;
    EXPECT_EQ(pass.references[i].map_from_base, (Pose2{3.0, -4.0, 2.5}));
    ASSERT_TRUE(pass.references[i].base_from_laser);
    EXPECT_LT(distance_m(*pass.references[i].base_from_laser, base_from_laser), 1e-14);
    EXPECT_LT(heading_difference_rad(*pass.references[i].base_from_laser, base_from_laser), 1e-14);
  }
}

TEST(CarmenWriter, ClockwiseSweepsKeepTheirTimes) {
  RawScan raw = sample_scans(1, 101)[0];
  raw.angle_min_rad = 2.0F;
  raw.angle_increment_rad = -0.03F;
  const Scan scan = Scan::make(raw).value();
  const Scan again = Scan::make(io::raw_from(scan)).value();
  EXPECT_NEAR(again.angle_min_rad(), scan.angle_min_rad(), 1e-6);  // a few last bits of a float
  EXPECT_EQ(again.angle_increment_rad(), scan.angle_increment_rad());
  EXPECT_EQ(again.hit_count(), scan.hit_count());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_EQ(again.ranges_m()[i], scan.ranges_m()[i]);
    EXPECT_NEAR(again.beam_time_s(i), scan.beam_time_s(i), 1e-9);
  }
}

TEST(CarmenWriter, PosesComeBackBitForBit) {
  const TempFolder folder;
  const Odometry odometry{Stamp{1'234'567'890'123}, {0.1, 1e-17, -3.0}, Twist2{0.3, 0.0, 1.0 / 3.0}, "ODOM"};
  const ReferencePose reference{Stamp{-5}, {1e8, 2.0 / 3.0, 0.1}, std::nullopt, "TRUEPOS"};
  io::CarmenWriter writer(folder.path("log"));
  writer.write(odometry);
  writer.write(reference);
  ASSERT_TRUE(writer.close());
  const Pass pass = pass_over(folder.path("log"));
  ASSERT_THAT(pass.events, SizeIs(2));
  EXPECT_EQ(pass.odometry.at(0), odometry);
  EXPECT_EQ(pass.references.at(0), reference);
}

TEST(CarmenWriter, SaysWhenItCannotWrite) {
  io::CarmenWriter writer("/nowhere/at/all.log");
  EXPECT_FALSE(writer.good());
  writer.write(sample_scans(1, 3)[0]);
  EXPECT_FALSE(writer.close());
}

}  // namespace
}  // namespace beaconless
