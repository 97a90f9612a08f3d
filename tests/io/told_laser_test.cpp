// SPDX-License-Identifier: Apache-2.0
// The laser's place in MCAP files and ROS 1 bags; rosbag2_recording_test.cpp has the rules.
#include "beaconless/io/told_laser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/cdr_encode.hpp"
#include "beaconless/io/mcap_survey.hpp"
#include "beaconless/io/ros1_encode.hpp"

#include "mcap_samples.hpp"
#include "same_events.hpp"

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
#include "rosbag1_writer.hpp"
#endif

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr Pose2 kPlace{0.5, -0.25, 1.0};

/// Scans with the laser's place in their midst, on a topic of that name.
void write_mcap(const std::string& path, const io::McapLayout& layout, bool is_ros1, const char* topic) {
  io::McapWriter file(path, is_ros1 ? "ros1" : "ros2", layout);
  const std::string encoding = is_ros1 ? "ros1" : "cdr";
  const std::string ros = is_ros1 ? "/" : "/msg/";
  const auto scans = file.add_channel("/scan", encoding, {.name = "sensor_msgs" + ros + "LaserScan"});
  const auto fixed = file.add_channel(topic, encoding, {.name = "tf2_msgs" + ros + "TFMessage"});
  const auto raw = sample_scans(30, 50);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    file.write(scans, i, i, is_ros1 ? io::ros1::encode_laser_scan(raw[i]) : io::encode_laser_scan(raw[i]));
    if (i != 10) continue;
    const auto encode = is_ros1 ? &io::ros1::encode_transform : &io::encode_transform;
    file.write(fixed, i, i, encode(raw[i].stamp, "base_link", raw[i].frame_id, kPlace));
  }
  EXPECT_TRUE(file.finish());
}

TEST(ToldLaser, McapTellsItHoweverItIsLaidOut) {
  const TempFolder folder;
  for (const bool is_ros1 : {false, true})
    for (const auto& layout : every_layout()) {
      SCOPED_TRACE(name_of(layout) + (is_ros1 ? " ros1" : " cdr"));
      write_mcap(folder.path("a.mcap"), layout, is_ros1, "/robot/tf_static");
      const auto recording = io::open_recording(folder.path("a.mcap")).value();
      ASSERT_TRUE(recording.laser_place());
      expect_near(recording.laser_place()->base_from_laser, kPlace);
      EXPECT_EQ(recording.laser_place()->told_by, "/robot/tf_static, base_link -> base_laser_link");
      EXPECT_THAT(pass_over(folder.path("a.mcap")).scans, SizeIs(30));
    }
}

TEST(ToldLaser, AConstantTransformOnTfIsNotTrusted) {
  const TempFolder folder;
  write_mcap(folder.path("a.mcap"), {}, false, "/tf");
  EXPECT_FALSE(io::open_recording(folder.path("a.mcap"))->laser_place());
}

TEST(ToldLaser, OnlyTheChunksThatHoldItAreUnpackedForIt) {
  const TempFolder folder;
  for (const auto& layout : every_layout()) {
    if (layout.chunk_bytes == 0) continue;
    SCOPED_TRACE(name_of(layout));
    write_mcap(folder.path("a.mcap"), layout, true, "/tf_static");
    const auto survey = io::survey_mcap(folder.path("a.mcap")).value();
    std::size_t holding = 0;
    for (const io::McapPart& part : survey.parts) {
      EXPECT_TRUE(part.channels.contains(1));
      holding += part.channels.contains(2) ? 1 : 0;
    }
    EXPECT_GT(survey.parts.size(), 5U);
    EXPECT_EQ(holding, 1U);
  }
}

TEST(ToldLaser, TheSourceIsAskedForNoMoreThanItNeeds) {
  /// A transform and then scans without an end.
  struct Source : io::RosMessageSource {
    Source(std::string of, int* count) : topic(std::move(of)), asked(count) {}
    Step next(io::RosMessage& message) override {
      ++*asked;
      const bool is_scan = topic == "/scan";
      const RawScan raw = sample_scans(1, 3)[0];
      const std::string body =
          is_scan ? io::encode_laser_scan(raw) : io::encode_transform({}, "base_link", raw.frame_id, kPlace);
      message = {topic,
                 is_scan ? "sensor_msgs/msg/LaserScan" : "tf2_msgs/msg/TFMessage",
                 true,
                 0,
                 {body.begin(), body.end()}};
      return Step::message;
    }
    std::string topic;
    int* asked;
  };
  int asked = 0;
  const auto open = [&](const std::vector<std::string>& topics) {
    return std::make_unique<Source>(topics.at(0), &asked);
  };
  const std::vector<io::Topic> topics{{"/scan", "sensor_msgs/msg/LaserScan", 1'000'000},
                                      {"/tf_static", "tf2_msgs/msg/TFMessage", 3},
                                      {"/tf", "tf2_msgs/msg/TFMessage", 1'000'000}};
  EXPECT_TRUE(io::told_laser(open, topics, "/scan").place);
  EXPECT_EQ(asked, 3 + 1 + 1000);
  asked = 0;
  EXPECT_FALSE(io::told_laser(open, std::vector<io::Topic>{topics[0], topics[2]}, "/scan").place);
  EXPECT_EQ(asked, 0);
}

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER

TEST(ToldLaser, ARos1BagTellsIt) {
  const TempFolder folder;
  BagContent content;
  for (const RawScan& raw : sample_scans(20, 300))
    content.scans.push_back({raw.stamp.ns, raw.frame_id, raw.angle_min_rad, raw.angle_increment_rad,
                             raw.time_increment_s, raw.scan_time_s, raw.range_min_m, raw.range_max_m,
                             raw.ranges_m, raw.intensities});
  const std::int64_t stamp_ns = content.scans[7].stamp_ns;
  content.transforms.push_back({stamp_ns, 1.0, 2.0, 0.5});  // with one base_link -> laser beside it
  write_bag(folder.path("a.bag"), content, BagCompression::lz4);
  EXPECT_FALSE(io::open_recording(folder.path("a.bag"))->laser_place());
  for (const auto compression : {BagCompression::none, BagCompression::lz4, BagCompression::bz2}) {
    content.fixed = {{stamp_ns, 0.5, -0.25, 1.0}};
    write_bag(folder.path("a.bag"), content, compression);
    const auto recording = io::open_recording(folder.path("a.bag")).value();
    ASSERT_TRUE(recording.laser_place());
    expect_near(recording.laser_place()->base_from_laser, kPlace);
    EXPECT_EQ(recording.laser_place()->told_by, "/tf_static, base_link -> base_laser_link");
  }
}

#endif

}  // namespace
}  // namespace beaconless
