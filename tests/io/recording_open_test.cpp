// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording_samples.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

std::string refusal(const std::string& path) {
  const Pass pass = pass_over(path);
  return pass.error ? to_string(*pass.error) : "opened";
}

TEST(OpenRecording, SaysWhatItMet) {
  const TempFolder folder;
  EXPECT_THAT(refusal(folder.path("missing")), HasSubstr("no such file"));
  EXPECT_THAT(refusal(folder.write("empty", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(folder.path("")), HasSubstr("is a directory"));
  EXPECT_THAT(refusal(folder.write("db3", "SQLite format 3\0 and more"s)), HasSubstr("is cut"));
  EXPECT_THAT(refusal(folder.write("zst", "\x28\xB5\x2F\xFD....")), HasSubstr("unzstd"));
  EXPECT_THAT(refusal(folder.write("tum", "# t x y\n1 2 3 0 0 0 0 1\n")), HasSubstr("trajectory"));
  EXPECT_THAT(refusal(folder.write("map", "image: hall.pgm\n")), HasSubstr("is a map"));
  EXPECT_THAT(refusal(folder.write("comments", "# one\n\n# two\n")), HasSubstr("nothing but"));
  EXPECT_THAT(refusal(folder.write("letter", "Dear robot,\n")), HasSubstr("begins with 'Dear robot,'"));
  EXPECT_THAT(refusal(folder.write("noise", "\x01\x02\xFF\xFE\x00 x"s)), HasSubstr("begins with '????"));
  EXPECT_THAT(refusal(folder.write("csv", "%time,field.header.seq\n")), HasSubstr("without -p"));
}

TEST(OpenRecording, ARosbag2FolderIsNamed) {
  const TempFolder folder;
  folder.write("metadata.yaml", "rosbag2_bagfile_information:\n");
  EXPECT_THAT(refusal(folder.path("")), HasSubstr("lists no files"));
}

TEST(OpenRecording, TheNameOfTheFileDoesNotMatter) {
  const TempFolder folder;
  EXPECT_EQ(refusal(folder.write("log.bag", "ODOM 1 2 3 0 0 0 1 h 1\n")), "opened");
}

TEST(OpenRecording, EveryPassBeginsAgain) {
  const TempFolder folder;
  const auto recording =
      io::open_recording(folder.write("log", "ODOM 1 2 3 0 0 0 1 h 1\nODOM 1 2 3 0 0 0 2 h 1\n")).value();
  for (int pass = 0; pass < 3; ++pass) {
    int events = 0;
    for (const Event& event : recording) events += std::holds_alternative<Odometry>(event) ? 1 : 0;
    EXPECT_EQ(events, 2);
  }
}

}  // namespace
}  // namespace beaconless
