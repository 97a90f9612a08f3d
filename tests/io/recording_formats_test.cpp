// SPDX-License-Identifier: Apache-2.0
// What must hold for every format of recordings alike.
#include <algorithm>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/rostopic_echo.hpp"

#include "recording_samples.hpp"
#include "rosbag2_writer.hpp"
#include "temp_folder.hpp"

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
#include "rosbag1_writer.hpp"
#endif

namespace beaconless {
namespace {

/// The same scans in each format: name and path.
std::vector<std::pair<std::string, std::string>> in_all_formats(const TempFolder& folder,
                                                                const std::vector<RawScan>& scans) {
  std::vector<std::pair<std::string, std::string>> files;
  EXPECT_TRUE(io::write_rostopic_echo(folder.path("echo"), scans));
  files.emplace_back("echo", folder.path("echo"));
  for (const char* name : {"carmen", "carmen.gz"}) {
    io::CarmenWriter writer(folder.path(name));
    for (const RawScan& scan : scans) {
      writer.write(scan, {1.0, 2.0, 3.0}, {0.1, 0.0, 0.0});
      writer.write(Odometry{scan.stamp, {1.0, 2.0, 3.0}, std::nullopt, "ODOM"});
    }
    EXPECT_TRUE(writer.close());
    files.emplace_back(name, folder.path(name));
  }
  std::vector<Bag2Message> messages;
  for (const RawScan& raw : scans) {
    const Odometry odometry{raw.stamp, {1.0, 2.0, 3.0}, std::nullopt, ""};
    messages.push_back({raw.stamp.ns, "/scan", "sensor_msgs/msg/LaserScan", cdr_of(raw)});
    messages.push_back({raw.stamp.ns, "/odom", "nav_msgs/msg/Odometry", cdr_of(odometry)});
  }
  write_bag2(folder.path("db3"), messages);
  files.emplace_back("db3", folder.path("db3"));
  files.emplace_back("db3.zstd", folder.write("db3.zstd", zstd_of(folder.read("db3"))));
#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
  BagContent content;
  for (const RawScan& raw : scans) {
    content.scans.push_back({raw.stamp.ns, raw.frame_id, raw.angle_min_rad, raw.angle_increment_rad,
                             raw.time_increment_s, raw.scan_time_s, raw.range_min_m, raw.range_max_m,
                             raw.ranges_m, raw.intensities});
    content.odometry.push_back({raw.stamp.ns, 1.0, 2.0, 3.0});
    content.transforms.push_back({raw.stamp.ns, 1.0, 2.0, 3.0});
  }
  for (const auto& [name, compression] : {std::pair{"bag", BagCompression::none},
                                          {"bz2.bag", BagCompression::bz2},
                                          {"lz4.bag", BagCompression::lz4}}) {
    write_bag(folder.path(name), content, compression);
    files.emplace_back(name, folder.path(name));
  }
#endif
  return files;
}

TEST(RecordingFormats, GiveBitIdenticalScans) {
  const TempFolder folder;
  const auto raws = sample_scans(10, 1081);
  for (const auto& [name, path] : in_all_formats(folder, raws)) {
    const Pass pass = pass_over(path);
    ASSERT_FALSE(pass.error) << name << ": " << *pass.error;
    ASSERT_EQ(pass.scans.size(), raws.size()) << name;
    for (std::size_t i = 0; i < raws.size(); ++i)
      EXPECT_EQ(pass.scans[i], Scan::make(raws[i]).value()) << name;
  }
}

/// A damaged file may give fewer events, never an exception, a hang, or something that is not finite.
void expect_survives(const std::string& path, std::size_t at_most) {
  const Pass pass = pass_over(path);
  EXPECT_LE(pass.scans.size(), at_most);
  for (const Odometry& odometry : pass.odometry) EXPECT_TRUE(odometry.odom_from_base.is_finite());
  for (const ReferencePose& reference : pass.references) EXPECT_TRUE(reference.map_from_base.is_finite());
}

TEST(RecordingFormats, CutAnywhereTheyGiveTheirBeginningOrAnError) {
  const TempFolder folder;
  for (const auto& [name, path] : in_all_formats(folder, sample_scans(4, 20))) {
    const std::string whole = folder.read(name);
    const auto all = pass_over(path).events;
    for (const std::size_t cut : cuts(whole.size())) {
      const Pass pass = pass_over(folder.write("cut", whole.substr(0, cut)));
      ASSERT_LE(pass.events.size(), all.size()) << name << " cut at " << cut;
      EXPECT_TRUE(std::equal(pass.events.begin(), pass.events.end(), all.begin()))
          << name << " cut at " << cut;
    }
  }
}

TEST(RecordingFormats, SurviveFlippedBytes) {
  const TempFolder folder;
  const auto raws = sample_scans(4, 20);
  Rng rng(11);
  for (const auto& [name, path] : in_all_formats(folder, raws)) {
    const std::string whole = folder.read(name);
    const bool is_bag = name.find("bag") != name.npos;
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = whole;
      const auto flips = 1 + rng.bits() % 4;
      for (std::uint64_t i = 0; i < flips; ++i) {
        // Most flips in a bag go past the padding, where its records are.
        const std::size_t first =
            is_bag && rng.uniform() < 0.8 ? std::min<std::size_t>(4117, whole.size() / 2) : 0;
        damaged[first + rng.bits() % (whole.size() - first)] = static_cast<char>(rng.bits());
      }
      expect_survives(folder.write("damaged", damaged), 100);
    }
  }
}

}  // namespace
}  // namespace beaconless
