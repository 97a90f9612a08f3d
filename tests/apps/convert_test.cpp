// SPDX-License-Identifier: Apache-2.0
// convert, and the MCAP file of localize.
#include <map>

#include <gmock/gmock.h>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/recording_writer.hpp"

#include "tests/apps/drive.hpp"

namespace beaconless {
namespace {

using testing::HasSubstr;

class Convert : public Drive {
 protected:
  static std::vector<Scan> scans_of(const std::string& path) {
    std::vector<Scan> scans;
    for (const Event& event : io::open_recording(path).value())
      if (const auto* scan = std::get_if<Scan>(&event)) scans.push_back(*scan);
    return scans;
  }
};

TEST_F(Convert, SaysWhatWentIntoTheCopy) {
  const Ran ran = run({"convert", recording(), folder.path("a.mcap"), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(ran.json()["scans"], kScans);
  EXPECT_EQ(ran.json()["bytes"], folder.read("a.mcap").size());
  EXPECT_THAT(folder.read("a.mcap"), HasSubstr("ros2"));
}

TEST_F(Convert, ScansComeBackAsTheSameBitsByEveryWay) {
  const auto scans = scans_of(recording());
  for (const char* packed : {"none", "lz4", "zstd"}) {
    const std::string copy = folder.path(std::string(packed) + ".mcap");
    ASSERT_EQ(run({"convert", recording(), copy, "--compression", packed}).exit_code, 0);
    EXPECT_EQ(scans_of(copy), scans) << packed;
    const std::string back = folder.path(std::string(packed) + ".log.gz");
    ASSERT_EQ(run({"convert", copy, back}).exit_code, 0);
    EXPECT_EQ(scans_of(back), scans) << packed;
  }
}

TEST_F(Convert, FromFormatToFormatAndBack) {
  const auto scans = scans_of(recording());
  std::string from = recording();
  std::vector<std::string> names{"a.mcap", "b.db3", "c_bag/"};
#ifdef BEACONLESS_HAS_ROSBAG1
  names.insert(names.end(), {"d.bag", "e.mcap"});
#endif
  for (const std::string& name : names) {
    const std::string to = folder.path(name);
    const Ran ran = run({"convert", from, to, "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.json()["scans"], kScans);
    EXPECT_GT(ran.json()["bytes"], 40'000);
    EXPECT_EQ(scans_of(to), scans) << name;
    from = to;
  }
}

TEST_F(Convert, TheLasersPlaceGoesAlong) {
  ASSERT_EQ(run(localize() + Words{"--out-mcap", folder.path("run.mcap")}).exit_code, 0);
  std::string from = folder.path("run.mcap");
  for (const char* name : {"a.db3", "b/", "c.log", "d.mcap"}) {
    ASSERT_EQ(run({"convert", from, folder.path(name)}).exit_code, 0);
    from = folder.path(name);
    const auto told = run({"info", from, "--json"}).json();
    EXPECT_NEAR(told["base_from_laser"][0].get<double>(), 0.7, 1e-12) << told;
  }
}

TEST_F(Convert, ALogSaysWhatItHasNoRoomFor) {
  const std::string from = folder.path("two.mcap");
  auto writer = io::make_recording_writer(from).value();
  for (const Event& event : io::open_recording(recording()).value()) {
    writer->write(event);
    writer->write(Odometry{stamp_of(event), {}, std::nullopt, "/tf odom->base"});
    writer->write(Odometry{stamp_of(event), {}, Twist2{}, "/wheels"});
  }
  ASSERT_TRUE(writer->finish());
  const Ran ran = run({"--json", "convert", from, folder.path("two.log")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto left_out = ran.json()["left_out"];
  ASSERT_EQ(left_out.size(), 1U) << left_out;
  EXPECT_EQ(left_out.begin().value(), ran.json()["odometry"]);
  EXPECT_THAT(ran.err, HasSubstr("are left out"));
}

TEST_F(Convert, SomeScansCanBeChosen) {
  const Ran ran = run({"convert", recording(), folder.path("a.mcap"), "--scans", "0:10:2", "--json"});
  EXPECT_EQ(ran.json()["scans"], 5U);
}

TEST_F(Convert, WhatCannotBeWrittenIsSaid) {
  const std::vector<std::pair<Words, std::string>> calls{
      {{recording(), folder.path("a.pcap")}, ".mcap (MCAP)"},
      {{recording(), folder.path("none/a.mcap")}, "cannot be written"},
      {{recording(), recording()}, "is the recording itself"},
      {{folder.path("missing.bag"), folder.path("a.mcap")}, "no such file"},
      {{recording(), folder.path("a.mcap"), "--compression", "zip"}, "zstd"},
      {{recording(), folder.path("a.mcap"), "--compression", "bz2"}, "choose one of: zstd, lz4, none"},
      {{recording(), folder.path("a.bag"), "--compression", "zstd"}, "choose one of: lz4, bz2, none"},
      {{recording(), folder.path("a.db3"), "--compression", "none"}, "leave the compression out"},
      {{recording(), folder.path("a.log"), "--compression", "none"}, "leave the compression out"},
      {{recording(), folder.path("sim/")}, "not empty"}};
  for (const auto& [words, said] : calls) {
    const Ran ran = run(Words{"convert"} + words);
    EXPECT_NE(ran.exit_code, 0) << words[1];
    EXPECT_THAT(ran.err, HasSubstr(said));
  }
}

TEST_F(Convert, ALocalizedDriveBecomesAFileForViewers) {
  const Ran ran = run(localize() + Words{"--out-mcap", folder.path("run.mcap")});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto told = run({"info", folder.path("run.mcap"), "--json"}).json();
  std::map<std::string, std::string> topics;
  for (const auto& topic : told["topics"]) {
    topics[topic["name"]] = topic["type"];
    EXPECT_EQ(topic["count"], topic["name"] == "/tf_static" ? 1U : kScans);
  }
  EXPECT_EQ(topics, (std::map<std::string, std::string>{
                        {"/scan", "sensor_msgs/msg/LaserScan"},
                        {"/beaconless/pose", "geometry_msgs/msg/PoseWithCovarianceStamped"},
                        {"/tf", "tf2_msgs/msg/TFMessage"},
                        {"/tf_static", "tf2_msgs/msg/TFMessage"},
                        {"/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"}}));
}

TEST_F(Convert, AnMcapFileThatCannotBeWrittenEndsTheRun) {
  const Ran ran = run(localize() + Words{"--out-mcap", folder.path("none/run.mcap")});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, HasSubstr("cannot be written"));
}

TEST_F(Convert, WindowsAreNoDrive) {
  const Ran ran = run({"localize", recording(), "--map", plan(), "--start", "auto", "--windows", "5:5",
                       "--out-mcap", folder.path("run.mcap")});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_THAT(ran.err, HasSubstr("--out-mcap"));
}

}  // namespace
}  // namespace beaconless
