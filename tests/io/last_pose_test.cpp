// SPDX-License-Identifier: Apache-2.0
// The pose that survives switching off: written whole or not at all, and never believed on another map.
#include "beaconless/io/last_pose.hpp"

#include <filesystem>

#include <gmock/gmock.h>

#include "beaconless/io/atomic_file.hpp"
#include "beaconless/io/pose_saver.hpp"

#include "tests/io/temp_folder.hpp"

namespace beaconless::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PoseEstimate estimate_at(std::int64_t ns, double x_m, Status status = Status::ok, double quality = 0.9) {
  PoseEstimate estimate{.stamp = Stamp{ns},
                        .map_from_base = {x_m, -2.0 / 3.0, 3.0},
                        .status = status,
                        .reason = "",
                        .quality = quality};
  estimate.covariance << 1e-5, 2e-7, -3e-8, 2e-7, 4e-5, 5e-9, -3e-8, 5e-9, 6e-6;
  return estimate;
}

const MapIdentity kMap{"hall: 2.yaml", 0x0123456789abcdefU};

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

TEST(LastPose, ReadsBackBitForBit) {
  const TempFolder folder;
  const std::string path = folder.path("pose.yaml");
  for (const std::int64_t ns : {1'411'657'682'042'859'001L, -5'000'000'001L, 0L}) {
    const LastPose pose = last_pose_of(estimate_at(ns, 1.0 / 3.0), kMap);
    ASSERT_TRUE(write_last_pose(path, pose));
    EXPECT_EQ(read_last_pose(path).value(), pose);
  }
  EXPECT_THAT(files_in(folder.path(".")), ElementsAre("pose.yaml")) << "nothing is left beside it";
}

TEST(LastPose, EveryFileThatIsCutShortIsRefused) {
  const TempFolder folder;
  ASSERT_TRUE(write_last_pose(folder.path("pose.yaml"), last_pose_of(estimate_at(1, 12.5), kMap)));
  const std::string whole = folder.read("pose.yaml");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(read_last_pose(folder.write("cut.yaml", whole.substr(0, size)))) << size;
  std::string edited = whole;
  edited.replace(edited.find("x_m: 12.5"), 9, "x_m: 13.5");
  EXPECT_THAT(read_last_pose(folder.write("edited.yaml", edited)).error().what, HasSubstr("edited"));
}

/// A file as another program might write it, with a sound last line.
std::string signed_text(const std::string& body) {
  return body + "checksum: " + hash_text(fnv1a(body)) + "\n";
}

TEST(LastPose, WhatIsWrongIsNamedWithItsLine) {
  const TempFolder folder;
  ASSERT_TRUE(write_last_pose(folder.path("pose.yaml"), last_pose_of(estimate_at(1, 12.5), kMap)));
  std::string body = folder.read("pose.yaml");
  body.erase(body.find("checksum: "));
  ASSERT_TRUE(read_last_pose(folder.write("same.yaml", signed_text(body))));
  const std::vector<std::array<std::string, 3>> wrongs{
      {"x_m: 12.5", "x_m: .nan", "x_m"},
      {"x_m: 12.5", "x_m: 1e999", "x_m"},
      {"x_m: 12.5\n", "", "there is no x_m"},
      {"status: ok", "status: fine", "\"fine\""},
      {"covariance: [1e-05, ", "covariance: [", "covariance"},
      {"covariance: [1e-05", "covariance: [.inf", "covariance"},
      {"stamp: 0.000000001", "stamp: today", "stamp"},
      {"fnv1a-0123456789abcdef", "fnv1a-0123", "map_hash"}};
  for (const auto& [from, to, told] : wrongs) {
    std::string text = body;
    ASSERT_NE(text.find(from), std::string::npos) << from << "\n" << text;
    text.replace(text.find(from), from.size(), to);
    const auto read = read_last_pose(folder.write("wrong.yaml", signed_text(text)));
    ASSERT_FALSE(read) << to;
    EXPECT_THAT(read.error().where, HasSubstr("wrong.yaml"));
    EXPECT_THAT(read.error().what, HasSubstr(told));
    EXPECT_THAT(read.error().remedy, HasSubstr("auto"));
  }
  EXPECT_THAT(read_last_pose(folder.path("gone.yaml")).error().what, HasSubstr("no such file"));
  EXPECT_THAT(read_last_pose(folder.write("empty.yaml", "")).error().what, HasSubstr("empty"));
}

TEST(LastPose, IsOfOneMapInOneState) {
  const TempFolder folder;
  const std::string map = folder.write("hall.yaml", "image: hall.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_FALSE(identify_map(map)) << "its picture is not there";
  folder.write("hall.pgm", "P5 1 1 255 0");
  const MapIdentity before = identify_map(map).value();
  EXPECT_EQ(before.name, "hall.yaml");
  EXPECT_EQ(identify_map(map).value(), before);
  const LastPose pose = last_pose_of(estimate_at(1, 0.0), before);
  EXPECT_TRUE(check_map(pose, "p", before));

  folder.write("hall.pgm", "P5 1 1 255 1");
  const MapIdentity painted = identify_map(map).value();
  EXPECT_THAT(check_map(pose, "p", painted).error().what, HasSubstr("has changed"));
  const std::string plan = folder.write("plan.yaml", "walls: []\n");
  EXPECT_THAT(check_map(pose, "p", identify_map(plan).value()).error().what,
              HasSubstr("on the map hall.yaml, not on plan.yaml"));
}

TEST(Fnv1a, IsTheOneThatIsPublished) {
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8U);
  EXPECT_EQ(fnv1a("bar", fnv1a("foo")), fnv1a("foobar"));
}

TEST(AtomicFile, AFailureLeavesTheOldFile) {
  const TempFolder folder;
  const std::string path = folder.write("a", "old");
  std::filesystem::create_directory(folder.path("a.part"));
  EXPECT_FALSE(write_file_atomically(path, "new"));
  EXPECT_EQ(folder.read("a"), "old");
  std::filesystem::remove(folder.path("a.part"));
  ASSERT_TRUE(write_file_atomically(path, "new"));
  EXPECT_EQ(folder.read("a"), "new");
  EXPECT_THAT(write_file_atomically(folder.path("gone/a"), "new").error().remedy, HasSubstr("folder"));
}

TEST(PoseSaver, WritesTheLastGoodPoseOnceASecondAndAtTheEnd) {
  const TempFolder folder;
  const std::string path = folder.path("pose.yaml");
  PoseSaver saver(path, kMap);
  const auto saved_x = [&] { return read_last_pose(path).value().map_from_base.x_m; };
  ASSERT_TRUE(saver.update(estimate_at(0, 9.0, Status::degraded)));
  EXPECT_FALSE(read_last_pose(path)) << "only good poses count";
  ASSERT_TRUE(saver.update(estimate_at(0, 1.0)));
  EXPECT_EQ(saved_x(), 1.0);
  ASSERT_TRUE(saver.update(estimate_at(999'999'999, 2.0)));
  EXPECT_EQ(saved_x(), 1.0);
  ASSERT_TRUE(saver.update(estimate_at(1'000'000'000, 3.0)));
  EXPECT_EQ(saved_x(), 3.0);
  ASSERT_TRUE(saver.update(estimate_at(1'500'000'000, 4.0)));
  ASSERT_TRUE(saver.update(estimate_at(5'000'000'000, 5.0, Status::lost)));
  EXPECT_EQ(saved_x(), 3.0);
  ASSERT_TRUE(saver.finish());
  EXPECT_EQ(saved_x(), 4.0);
  ASSERT_TRUE(saver.update(estimate_at(-7'000'000'000, 6.0)));
  EXPECT_EQ(saved_x(), 6.0) << "a clock that is set back does not stop it";
}

TEST(PoseSaver, APoseThatDeservesNoTrustIsNotSaved) {
  const TempFolder folder;
  const std::string path = folder.path("pose.yaml");
  PoseSaver saver(path, kMap);
  ASSERT_TRUE(saver.update(estimate_at(0, 1.0, Status::ok, 0.49)));
  ASSERT_TRUE(saver.finish());
  EXPECT_FALSE(read_last_pose(path));
  ASSERT_TRUE(saver.update(estimate_at(2'000'000'000, 2.0, Status::ok, 0.5)));
  ASSERT_TRUE(saver.update(estimate_at(4'000'000'000, 3.0, Status::ok, 0.1)));
  ASSERT_TRUE(saver.finish());
  EXPECT_EQ(read_last_pose(path).value().map_from_base.x_m, 2.0);
}

TEST(PoseSaver, TellsADiskThatRefusesAndTriesAgain) {
  const TempFolder folder;
  PoseSaver saver(folder.path("later/pose.yaml"), kMap);
  EXPECT_FALSE(saver.update(estimate_at(0, 1.0)));
  std::filesystem::create_directory(folder.path("later"));
  ASSERT_TRUE(saver.finish());
  EXPECT_EQ(read_last_pose(folder.path("later/pose.yaml")).value().map_from_base.x_m, 1.0);
}

}  // namespace
}  // namespace beaconless::io
