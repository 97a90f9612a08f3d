// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag1_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/ros1_message.hpp"

#include "recording_samples.hpp"
#include "temp_folder.hpp"

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
#include "rosbag1_writer.hpp"
#endif

namespace beaconless {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

TEST(Ros1Message, APromiseOfFourBillionBeamsAllocatesNothing) {
  std::vector<unsigned char> bytes(16 + 28 + 4, 0);  // header with an empty frame, seven floats, a length
  for (std::size_t i = bytes.size() - 4; i < bytes.size(); ++i) bytes[i] = 0xFF;
  EXPECT_FALSE(io::ros1::decode_laser_scan(bytes));
}

TEST(Ros1Message, NoiseNeverDecodesBeyondItsEnd) {
  Rng rng(7);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<unsigned char> bytes(rng.bits() % 120);
    for (auto& byte : bytes) byte = rng.uniform() < 0.7 ? 0 : static_cast<unsigned char>(rng.bits());
    (void)io::ros1::decode_laser_scan(bytes);
    (void)io::ros1::decode_odometry(bytes);
    (void)io::ros1::decode_pose_stamped(bytes);
    (void)io::ros1::decode_pose_with_covariance_stamped(bytes);
    (void)io::ros1::decode_transforms(bytes);
  }
}

TEST(Rosbag1, OtherFormatsAreRefusedByName) {
  const TempFolder folder;
  for (const std::string name : {"#ROSRECORD V1.2", "#ROSBAG V1.2", "#ROSBAG V3.0"}) {
    const Pass pass = pass_over(folder.write("bag", name + "\nop=\x05"));
    ASSERT_TRUE(pass.error);
    EXPECT_THAT(pass.error->what, testing::AnyOf(HasSubstr(name), HasSubstr("without reading them")));
  }
}

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER

BagContent sample_content() {
  BagContent content;
  for (const RawScan& raw : sample_scans(20, 300))
    content.scans.push_back({raw.stamp.ns, raw.frame_id, raw.angle_min_rad, raw.angle_increment_rad,
                             raw.time_increment_s, raw.scan_time_s, raw.range_min_m, raw.range_max_m,
                             raw.ranges_m, raw.intensities});
  for (std::size_t i = 0; i < content.scans.size(); ++i) {
    const std::int64_t stamp_ns = content.scans[i].stamp_ns;
    const auto x_m = static_cast<double>(i);
    content.odometry.push_back({stamp_ns + 1, x_m, 2.0, 0.1});
    content.transforms.push_back({stamp_ns + 2, x_m, 3.0, 0.2});
    content.poses.push_back({stamp_ns + 3, x_m, 4.0, 0.3});
    content.fixes.push_back({stamp_ns + 4, x_m, 5.0, 0.4});
  }
  return content;
}

TEST(Rosbag1, AllThatARobotRecordsComesBackInOrder) {
  const TempFolder folder;
  const BagContent content = sample_content();
  for (const auto compression : {BagCompression::none, BagCompression::bz2, BagCompression::lz4}) {
    write_bag(folder.path("bag"), content, compression);
    const Pass pass = pass_over(folder.path("bag"));
    ASSERT_FALSE(pass.error) << *pass.error;
    EXPECT_THAT(pass.problems, SizeIs(0));
    ASSERT_THAT(pass.events, SizeIs(5 * 20));
    for (std::size_t i = 0; i + 1 < pass.events.size(); ++i)
      EXPECT_LT(stamp_of(pass.events[i]), stamp_of(pass.events[i + 1]));
    const auto scans = sample_scans(20, 300);
    for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(pass.scans[i], Scan::make(scans[i]).value());
    EXPECT_EQ(pass.odometry[4].source, "/odom");
    EXPECT_EQ(pass.odometry[4].twist_per_s, (Twist2{1.0, 2.0, 3.0}));
    EXPECT_EQ(pass.odometry[5].source, "/tf /odom->base_link");
    EXPECT_EQ(pass.odometry[5].odom_from_base.y_m, 3.0);
    EXPECT_EQ(pass.references[4].source, "/reference");
    EXPECT_EQ(pass.references[5].source, "/amcl_pose");
    EXPECT_EQ(pass.references[5].map_from_base.x_m, 2.0);
    EXPECT_NEAR(pass.references[5].map_from_base.theta_rad, 0.4, 1e-15);
  }
}

TEST(Rosbag1, TopicsAreListedAndChosen) {
  const TempFolder folder;
  BagContent content = sample_content();
  content.more_scans = content.scans;
  content.more_scans.resize(3);
  write_bag(folder.path("bag"), content, BagCompression::lz4);
  const Pass undecided = pass_over(folder.path("bag"));
  ASSERT_TRUE(undecided.error);
  EXPECT_THAT(undecided.error->what, HasSubstr("/scan (20 scans)"));
  EXPECT_THAT(undecided.error->what, HasSubstr("/rear/scan (3 scans)"));
  EXPECT_THAT(pass_over(folder.path("bag"), {.topic = "rear/scan"}).scans, SizeIs(3));
  const Pass wrong = pass_over(folder.path("bag"), {.topic = "/rear/scn"});
  ASSERT_TRUE(wrong.error);
  EXPECT_THAT(wrong.error->remedy, HasSubstr("/rear/scan"));
}

TEST(Rosbag1, ADamagedChunkLosesItsMessagesOnly) {
  const TempFolder folder;
  write_bag(folder.path("bag"), sample_content(), BagCompression::bz2);
  std::string bytes = folder.read("bag");
  const std::size_t chunk = bytes.find("BZh", bytes.find("BZh") + 1);
  bytes[chunk + 200] = static_cast<char>(~bytes[chunk + 200]);
  const Pass pass = pass_over(folder.write("bag", bytes));
  ASSERT_FALSE(pass.error) << *pass.error;
  EXPECT_THAT(pass.problems, testing::Not(SizeIs(0)));
  EXPECT_EQ(pass.events.size() + pass.problems.size(), 5U * 20U);
}

TEST(Rosbag1, ABagThatWasCutIsRefusedWithTheRemedy) {
  const TempFolder folder;
  write_bag(folder.path("bag"), sample_content(), BagCompression::lz4);
  const std::string bytes = folder.read("bag");
  for (std::size_t cut = 14; cut < bytes.size(); cut += 997) {
    const Pass pass = pass_over(folder.write("cut", bytes.substr(0, cut)));
    ASSERT_TRUE(pass.error) << cut;
    EXPECT_THAT(pass.error->remedy, HasSubstr("rosbag reindex"));
    EXPECT_THAT(pass.error->where, HasSubstr("@"));
  }
}

#endif

}  // namespace
}  // namespace beaconless
