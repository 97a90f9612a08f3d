// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/recording_writer.hpp"

#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "same_events.hpp"
#include "temp_folder.hpp"

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
#include "rosbag1_writer.hpp"
#endif

namespace beaconless {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

/// What a robot with a laser ahead of its base records, in an order that is not that of the stamps.
std::vector<Event> a_drive() {
  std::vector<Event> events;
  for (const RawScan& raw : sample_scans(12, 40)) {
    const Stamp stamp = raw.stamp;
    const double x_m = static_cast<double>(events.size());
    events.emplace_back(Odometry{stamp, {x_m, 2.0, 0.1 * x_m}, Twist2{1.0, 0.5, -0.25}, "/wheels"});
    events.emplace_back(Odometry{{stamp.ns + 7}, {x_m, -2.0, 3.0}, std::nullopt, "/tf odom->base"});
    events.emplace_back(ReferencePose{{stamp.ns - 9}, {1.0, x_m, -3.1}, std::nullopt, "/truth"});
    events.emplace_back(Scan::make(raw).value());
  }
  return events;
}

const io::LaserPlace kPlace{{0.25, -0.125, 0.5}, "/tf_static, base -> base_laser_link", "base"};

Result<Done> write_all(const std::string& path, const std::vector<Event>& events,
                       io::RecordingWriterOptions options = {}) {
  auto writer = io::make_recording_writer(path, options);
  if (!writer) return writer.error();
  for (const Event& event : events) writer.value()->write(event);
  return writer.value()->finish();
}

/// The formats that hold all of an event.
std::vector<const char*> whole_formats() {
  std::vector<const char*> names{"a.mcap", "a.db3", "a_bag/"};
#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
  names.push_back("a.bag");
#endif
  return names;
}

TEST(RecordingWriter, TheEndOfTheNameDecides) {
  const TempFolder folder;
  auto names = whole_formats();
  names.insert(names.end(), {"a.log", "a.clf", "a.log.gz"});
  for (const char* name : names) {
    ASSERT_TRUE(write_all(folder.path(name), a_drive())) << name;
    EXPECT_EQ(pass_over(folder.path(name)).scans.size(), 12U) << name;
  }
  EXPECT_THAT(to_string(io::make_recording_writer("a.pcap").error()), HasSubstr(".mcap (MCAP)"));
}

TEST(RecordingWriter, EveryFormatOfRosHoldsAllOfIt) {
  const TempFolder folder;
  for (const char* name : whole_formats()) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(write_all(folder.path(name), a_drive(), {.scan_topic = "/front", .laser_place = kPlace}));
    const auto copy = io::open_recording(folder.path(name)).value();
    EXPECT_EQ(copy.scan_topic(), "/front");
    expect_same_events(a_drive(), copy);
    ASSERT_TRUE(copy.laser_place());
    EXPECT_EQ(copy.laser_place()->told_by, kPlace.told_by);
    EXPECT_EQ(copy.laser_place()->base_frame, "base");
    expect_near(copy.laser_place()->base_from_laser, kPlace.base_from_laser);
    EXPECT_FALSE(std::filesystem::exists(folder.path(name) + ".part"));
  }
}

TEST(RecordingWriter, ALogTellsTheLasersPlaceToo) {
  const TempFolder folder;
  ASSERT_TRUE(write_all(folder.path("a.log"), a_drive(), {.laser_place = kPlace}));
  EXPECT_EQ(io::open_recording(folder.path("a.log"))->laser_place()->base_from_laser, kPlace.base_from_laser);
}

TEST(RecordingWriter, ALogHoldsTheFirstSourceOfEachKindAndSaysWhatItLeftOut) {
  const TempFolder folder;
  auto writer = io::make_recording_writer(folder.path("a.log")).value();
  for (const Event& event : a_drive()) writer->write(event);
  writer->write(ReferencePose{{5}, {9.0, 9.0, 0.0}, std::nullopt, "/amcl_pose"});
  EXPECT_EQ(writer->left_out(),
            (std::map<std::string, io::LeftOut>{{"/tf odom->base", {12, 0}}, {"/amcl_pose", {0, 1}}}));
  ASSERT_TRUE(writer->finish());
  std::size_t odometry = 0;
  std::size_t poses = 0;
  for (const Event& event : io::open_recording(folder.path("a.log")).value()) {
    if (const auto* reading = std::get_if<Odometry>(&event)) {
      EXPECT_EQ(reading->odom_from_base.y_m, 2.0);
      ++odometry;
    }
    poses += std::holds_alternative<ReferencePose>(event) ? 1 : 0;
  }
  EXPECT_EQ(odometry, 12U);
  EXPECT_EQ(poses, 12U);
}

TEST(RecordingWriter, TheFirstPlaceThatAReferenceTellsIsTaken) {
  const TempFolder folder;
  auto names = whole_formats();
  names.push_back("a.log");
  for (const char* name : names) {
    auto events = a_drive();
    std::get<ReferencePose>(events[2]).base_from_laser = Pose2{0.5, 0.0, 0.0};
    std::get<ReferencePose>(events[6]).base_from_laser = Pose2{0.75, 0.0, 0.0};
    ASSERT_TRUE(write_all(folder.path(name), events));
    const auto copy = io::open_recording(folder.path(name)).value();
    ASSERT_TRUE(copy.laser_place()) << name;
    EXPECT_EQ(copy.laser_place()->base_from_laser, (Pose2{0.5, 0.0, 0.0})) << name;
  }
}

TEST(RecordingWriter, AFrameWithoutANameGetsOneWhereTheLaserIsPlaced) {
  const TempFolder folder;
  RawScan raw = sample_scans(1, 20)[0];
  raw.frame_id.clear();
  const std::vector<Event> events{Scan::make(raw).value()};
  ASSERT_TRUE(write_all(folder.path("a.db3"), events));
  EXPECT_EQ(pass_over(folder.path("a.db3")).scans[0].frame_id(), "");
  ASSERT_TRUE(
      write_all(folder.path("a.db3"), events, {.laser_place = io::LaserPlace{{1.0, 0.0, 0.0}, "", ""}}));
  EXPECT_EQ(pass_over(folder.path("a.db3")).scans[0].frame_id(), "laser");
  EXPECT_EQ(io::open_recording(folder.path("a.db3"))->laser_place()->told_by,
            "/tf_static, base_link -> laser");
}

TEST(RecordingWriter, ACompressionWithoutEffectIsRefused) {
  const TempFolder folder;
  for (const auto& [name, packed, is_good] :
       std::vector<std::tuple<const char*, const char*, bool>>{{"a.mcap", "zstd", true},
                                                               {"a.mcap", "lz4", true},
                                                               {"a.mcap", "none", true},
                                                               {"a.mcap", "bz2", false},
                                                               {"a.bag", "bz2", true},
                                                               {"a.bag", "lz4", true},
                                                               {"a.bag", "none", true},
                                                               {"a.bag", "zstd", false},
                                                               {"a.db3", "none", false},
                                                               {"a/", "zstd", false},
                                                               {"a.log", "none", false}}) {
    const auto possible = io::can_write_recording(folder.path(name), {.compression = packed});
    EXPECT_EQ(possible.ok(), is_good) << name << " " << packed;
    if (is_good) continue;
    EXPECT_THAT(to_string(possible.error()), HasSubstr(packed));
    EXPECT_FALSE(io::make_recording_writer(folder.path(name), {.compression = packed}));
  }
}

TEST(RecordingWriter, WhatIsNotFinishedLeavesTheOldOneAndNothingElse) {
  const TempFolder folder;
  for (const char* name : whole_formats()) {
    if (!std::string_view(name).ends_with('/')) folder.write(name, "old");
    {
      const auto writer = io::make_recording_writer(folder.path(name)).value();
      for (const Event& event : a_drive()) writer->write(event);
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path(name) + ".part")) << name;
    if (!std::string_view(name).ends_with('/')) {
      EXPECT_EQ(folder.read(name), "old");
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("a_bag")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a_bag.part")));
}

TEST(RecordingWriter, AFullDiskIsSaidAndTheOldCopyStays) {
  const TempFolder folder;
  auto names = whole_formats();
  names.push_back("a.log");
  const auto scans = sample_scans(60, 400);
  for (const char* name : names) {
    const bool is_folder = std::string_view(name).ends_with('/');
    if (!is_folder) folder.write(name, "old");
    const auto writer = io::make_recording_writer(folder.path(name)).value();
    const rlimit little{40'000, RLIM_INFINITY};
    rlimit usual{};
    getrlimit(RLIMIT_FSIZE, &usual);
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &little);
    for (const RawScan& raw : scans) writer->write(Scan::make(raw).value());
    const auto done = writer->finish();
    setrlimit(RLIMIT_FSIZE, &usual);
    signal(SIGXFSZ, SIG_DFL);
    ASSERT_FALSE(done) << name;
    EXPECT_THAT(to_string(done.error()), HasSubstr("cannot be written")) << name;
    EXPECT_FALSE(writer->good()) << name;
    if (!is_folder) {
      EXPECT_EQ(folder.read(name), "old");
    }
  }
}

TEST(RecordingWriter, AFolderThatHoldsSomethingIsNotWrittenOver) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path("bag"));
  EXPECT_TRUE(write_all(folder.path("bag"), a_drive()));  // empty, and a folder without being called one
  EXPECT_THAT(to_string(write_all(folder.path("bag/"), a_drive()).error()), HasSubstr("not empty"));
  EXPECT_FALSE(write_all(folder.path("none/bag/"), a_drive()));
  std::filesystem::create_directory(folder.path("other.part"));
  EXPECT_THAT(to_string(write_all(folder.path("other/"), a_drive()).error()), HasSubstr("in the way"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("other.part")));
}

TEST(RecordingWriter, AFolderHasTheMetadataOfItsBag) {
  const TempFolder folder;
  ASSERT_TRUE(write_all(folder.path("my bag/"), a_drive(), {.laser_place = kPlace}));
  const std::string metadata = folder.read("my bag/metadata.yaml");
  for (const char* said :
       {"version: 5", "storage_identifier: sqlite3", "message_count: 49\n", "path: \"my bag_0.db3\"",
        "name: \"/tf_static\"\n        type: tf2_msgs/msg/TFMessage", "durability: 1\\n", "durability: 2\\n"})
    EXPECT_THAT(metadata, HasSubstr(said));
  EXPECT_THAT(pass_over(folder.path("my bag")).events, SizeIs(48));
}

TEST(RecordingWriter, ManyMessagesPassTheEndOfATransaction) {
  const TempFolder folder;
  std::vector<Event> events;
  for (int i = 0; i < 12'345; ++i)
    events.emplace_back(Odometry{{i}, {0.5 * i, 0.0, 0.0}, std::nullopt, "/tf odom->base_link"});
  ASSERT_TRUE(write_all(folder.path("a.db3"), events));
  expect_same_events(events, io::open_recording(folder.path("a.db3"), {.scans_optional = true}).value());
}

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER

TEST(RecordingWriter, RosReadsItsBagsByItsOwnMessages) {
  const TempFolder folder;
  const auto raw = sample_scans(12, 40);
  for (const char* packed : {"none", "lz4", "bz2"}) {
    ASSERT_TRUE(write_all(folder.path("a.bag"), a_drive(), {.compression = packed, .laser_place = kPlace}));
    const BagContent read = read_bag(folder.path("a.bag"));  // checks the MD5 sum of every type
    ASSERT_THAT(read.scans, SizeIs(12));
    for (std::size_t i = 0; i < raw.size(); ++i) {
      EXPECT_EQ(read.scans[i].stamp_ns, raw[i].stamp.ns);
      EXPECT_EQ(read.scans[i].intensities, raw[i].intensities);
      EXPECT_EQ(read.scans[i].range_max_m, raw[i].range_max_m);
    }
    ASSERT_THAT(read.odometry, SizeIs(12));
    EXPECT_EQ(read.odometry[1].x_m, 4.0);
    ASSERT_THAT(read.poses, SizeIs(12));
    EXPECT_EQ(read.poses[1].y_m, 4.0);
    ASSERT_THAT(read.transforms, SizeIs(12));
    EXPECT_EQ(read.transforms[1].y_m, -2.0);
    ASSERT_THAT(read.fixed, SizeIs(1));
    EXPECT_EQ(read.fixed[0].x_m, 0.25);
    EXPECT_TRUE(read.is_fixed_latched);
  }
}

#endif

}  // namespace
}  // namespace beaconless
