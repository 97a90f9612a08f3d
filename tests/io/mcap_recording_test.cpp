// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mcap_samples.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(McapRecording, EveryLayoutGivesTheSameScans) {
  const TempFolder folder;
  const auto raw = sample_scans(20, 50);
  for (const auto& layout : every_layout()) {
    SCOPED_TRACE(name_of(layout));
    const std::string path = folder.path("a.mcap");
    write_ros1_mcap(path, raw, layout);
    const Pass pass = pass_over(path);
    ASSERT_FALSE(pass.error) << *pass.error;
    EXPECT_EQ(pass.scans, gated(raw));
    EXPECT_EQ(pass.problems.size(), layout.has_summary ? 0U : 1U);
    const auto recording = io::open_recording(path).value();
    EXPECT_EQ(recording.format(), "MCAP (ros1)");
    EXPECT_EQ(recording.scan_topic(), "/scan");
    EXPECT_EQ(recording.topics(), (std::vector<io::Topic>{{"/scan", "sensor_msgs/LaserScan", 20}}));
  }
}

TEST(McapRecording, MessagesOfChunksComeByLogTime) {
  const TempFolder folder;
  auto raw = sample_scans(40, 20);
  const auto sorted = gated(raw);
  for (std::size_t i = 0; i + 5 < raw.size(); i += 5) std::swap(raw[i], raw[i + 5]);  // chunks overlap
  write_ros1_mcap(folder.path("a.mcap"), raw, {io::McapCompression::lz4, 1000});
  EXPECT_EQ(pass_over(folder.path("a.mcap")).scans, sorted);
}

TEST(McapRecording, WithoutChunksTheOrderIsThatOfTheFile) {
  const TempFolder folder;
  auto raw = sample_scans(6, 20);
  std::reverse(raw.begin(), raw.end());
  write_ros1_mcap(folder.path("a.mcap"), raw, {.chunk_bytes = 0});
  EXPECT_EQ(pass_over(folder.path("a.mcap")).scans, gated(raw));
}

TEST(McapRecording, TheTopicIsChosen) {
  const TempFolder folder;
  {
    io::McapWriter file(folder.path("a.mcap"), "ros1");
    const auto raw = sample_scans(2, 20);
    for (const char* topic : {"/front", "/rear"}) {
      const auto id = file.add_channel(topic, "ros1", {.name = "sensor_msgs/LaserScan"});
      file.write(id, 1, 1, ros1_bytes(raw[topic[1] == 'f' ? 0 : 1]));
    }
  }
  EXPECT_THAT(to_string(*pass_over(folder.path("a.mcap")).error), HasSubstr("choose one with --topic"));
  const Pass rear = pass_over(folder.path("a.mcap"), {.topic = "rear"});
  ASSERT_EQ(rear.scans.size(), 1U);
  EXPECT_EQ(rear.scans[0], gated(sample_scans(2, 20))[1]);
}

TEST(McapRecording, AnEncodingThatIsNotReadIsNamed) {
  const TempFolder folder;
  {
    io::McapWriter file(folder.path("a.mcap"), "");
    file.add_channel("/scan", "json", {.name = "sensor_msgs/msg/LaserScan"});
  }
  EXPECT_THAT(to_string(*pass_over(folder.path("a.mcap")).error), HasSubstr("encoded as 'json'"));
}

TEST(McapRecording, RecordsThatNobodyKnowsArePassedOver) {
  const TempFolder folder;
  const auto raw = sample_scans(5, 20);
  write_ros1_mcap(folder.path("a.mcap"), raw, {.chunk_bytes = 0, .has_summary = false});
  std::string bytes = folder.read("a.mcap");
  const std::string foreign{"\x99\x03\0\0\0\0\0\0\0abc", 12};
  bytes.insert(io::kMcapMagic.size() + io::kMcapPrefixBytes + 4 + 4 + 4 + 10, foreign);  // behind the header
  folder.write("a.mcap", bytes);
  EXPECT_EQ(pass_over(folder.path("a.mcap")).scans, gated(raw));
}

TEST(McapRecording, ADamagedMessageIsPassedOverWithItsPlace) {
  const TempFolder folder;
  {
    io::McapWriter file(folder.path("a.mcap"), "ros1");
    const auto id = file.add_channel("/scan", "ros1", {.name = "sensor_msgs/LaserScan"});
    const std::string good = ros1_bytes(sample_scans(1, 20)[0]);
    file.write(id, 1, 1, good.substr(0, good.size() - 1));
    file.write(id, 2, 2, good);
  }
  const Pass pass = pass_over(folder.path("a.mcap"));
  EXPECT_EQ(pass.scans.size(), 1U);
  ASSERT_EQ(pass.problems.size(), 1U);
  EXPECT_THAT(pass.problems[0].where, HasSubstr("/scan recorded at 0.000000001"));
}

TEST(McapRecording, AFileWithoutMessagesHasNone) {
  const TempFolder folder;
  for (const auto& layout : every_layout()) {
    io::McapWriter(folder.path("a.mcap"), "ros2", layout);
    const Pass pass = pass_over(folder.path("a.mcap"));
    EXPECT_FALSE(pass.error);
    EXPECT_THAT(pass.events, IsEmpty());
  }
}

}  // namespace
}  // namespace beaconless
