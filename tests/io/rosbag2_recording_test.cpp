// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag2_recording.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "beaconless/io/zstd_file.hpp"

#include "recording_samples.hpp"
#include "rosbag2_writer.hpp"
#include "temp_folder.hpp"

namespace beaconless {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kScanType = "sensor_msgs/msg/LaserScan";
constexpr const char* kTfType = "tf2_msgs/msg/TFMessage";

std::vector<Bag2Message> messages_of(const std::vector<RawScan>& scans, const std::string& topic = "/scan") {
  std::vector<Bag2Message> messages;
  for (const RawScan& scan : scans)
    messages.push_back({scan.stamp.ns + 5'000'000, topic, kScanType, cdr_of(scan)});
  return messages;
}

/// One of each kind, in an order that is not that of the stamps.
std::vector<Bag2Message> a_drive() {
  auto messages = messages_of(sample_scans(3, 50));
  const std::int64_t from = messages.front().recorded_ns;
  messages.push_back(
      {from + 2, "/odom", "nav_msgs/msg/Odometry", cdr_of(Odometry{{7}, {1.0, 2.0, 0.5}, {}, ""})});
  messages.push_back({from + 1, "/tf", kTfType,
                      cdr_of({{{6}, "odom", "base_link", {3.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}})});
  messages.push_back(
      {from + 3, "/pose", "geometry_msgs/msg/PoseStamped", cdr_of(ReferencePose{{8}, {}, {}, ""}, 0)});
  messages.push_back({from + 4, "/amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped",
                      cdr_of(ReferencePose{{9}, {}, {}, ""}, 36)});
  messages.push_back({from + 5, "/image", "sensor_msgs/msg/Image", {1, 2, 3}});
  return messages;
}

io::FrameTransform fixed(const char* parent, const char* child, const Eigen::Vector3d& at, double yaw_rad,
                         double roll_rad = 0.0) {
  return {{0},
          parent,
          child,
          at,
          Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX())};
}

std::string refusal(const std::string& path) {
  const Pass pass = pass_over(path);
  return pass.error ? to_string(*pass.error) : "opened";
}

TEST(Rosbag2, GivesWhatWasRecordedInThatOrderOldSchemaAndNew) {
  const TempFolder folder;
  const auto scans = sample_scans(3, 50);
  for (const bool is_old : {false, true}) {
    const std::string path = folder.path(is_old ? "old.db3" : "new.db3");
    write_bag2(path, a_drive(), is_old);
    const Pass pass = pass_over(path);
    ASSERT_FALSE(pass.error) << *pass.error;
    EXPECT_THAT(pass.problems, IsEmpty());
    ASSERT_THAT(pass.events, SizeIs(7));
    std::vector<std::size_t> kinds;
    for (const Event& event : pass.events) kinds.push_back(event.index());
    EXPECT_THAT(kinds, ElementsAre(0, 1, 1, 2, 2, 0, 0));
    EXPECT_EQ(pass.odometry[0].source, "/tf odom->base_link");
    EXPECT_EQ(pass.odometry[1].source, "/odom");
    EXPECT_EQ(pass.references[0].source, "/pose");
    EXPECT_EQ(pass.references[1].source, "/amcl_pose");
    for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_EQ(pass.scans[i], Scan::make(scans[i]).value());
    const auto recording = io::open_recording(path).value();
    EXPECT_EQ(recording.format(), "ROS 2 bag (SQLite)");
    EXPECT_EQ(recording.scan_topic(), "/scan");
    EXPECT_THAT(recording.topics(), SizeIs(6));
  }
}

TEST(Rosbag2, SeveralFilesAreOneRecording) {
  const TempFolder folder;
  const auto messages = messages_of(sample_scans(12, 20));
  std::string listed =
      "rosbag2_bagfile_information:\n  storage_identifier: sqlite3\n  relative_file_paths:\n";
  for (std::size_t i = 0; i < 12; ++i) {
    const std::string name = "bag_" + std::to_string(i) + ".db3";
    write_bag2(folder.path(name), {messages[i]});
    if (i == 3) {
      folder.write(name + ".zstd", zstd_of(folder.read(name)));
      std::filesystem::remove(folder.path(name));
    }
    listed += "    - " + name + "\n";
  }
  for (const bool has_metadata : {false, true}) {
    if (has_metadata) folder.write("metadata.yaml", listed);
    const Pass pass = pass_over(folder.path(""));
    ASSERT_FALSE(pass.error) << *pass.error;
    ASSERT_THAT(pass.scans, SizeIs(12));
    EXPECT_THAT(pass.problems, IsEmpty());  // none that says that stamps run backwards
  }
  std::filesystem::remove(folder.path("bag_7.db3"));
  EXPECT_THAT(refusal(folder.path("")), testing::AllOf(HasSubstr("bag_7.db3"), HasSubstr("is not there")));
  folder.write("metadata.yaml", "rosbag2_bagfile_information:\n  storage_identifier: mcap\n");
  EXPECT_THAT(refusal(folder.path("")), HasSubstr("stored as \"mcap\""));
}

TEST(Rosbag2, CompressedFilesGiveTheSameAndLeaveNothingBehind) {
  const TempFolder folder;
  write_bag2(folder.path("bag.db3"), a_drive());
  const std::string packed = zstd_of(folder.read("bag.db3"));
  std::filesystem::create_directory(folder.path("tmp"));
  setenv("TMPDIR", folder.path("tmp").c_str(), 1);
  EXPECT_EQ(pass_over(folder.write("bag.db3.zstd", packed)).events, pass_over(folder.path("bag.db3")).events);
  for (std::size_t size = 5; size < packed.size(); size += 37)
    EXPECT_NE(refusal(folder.write("cut.db3.zstd", std::string_view(packed).substr(0, size))), "opened");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path("tmp")));
  unsetenv("TMPDIR");
}

TEST(Rosbag2, ACompressedFileIsKnownByItsFirstBlockHoweverLong) {
  const TempFolder folder;
  write_bag2(folder.path("bag.db3"), messages_of(sample_scans(60, 1000)));  // noise: packed to about its size
  const std::string packed = zstd_of(folder.read("bag.db3"));
  EXPECT_GT(packed.size(), 200'000U);
  EXPECT_THAT(pass_over(folder.write("bag.db3.zstd", packed)).scans, SizeIs(60));
}

TEST(Rosbag2, MessagesCompressedOneByOne) {
  const TempFolder folder;
  auto messages = a_drive();
  write_bag2(folder.path("plain.db3"), messages);
  for (Bag2Message& message : messages) {
    const std::string packed =
        zstd_of({reinterpret_cast<const char*>(message.bytes.data()), message.bytes.size()});
    message.bytes.assign(packed.begin(), packed.end());
  }
  write_bag2(folder.path("packed.db3"), messages);
  EXPECT_EQ(pass_over(folder.path("packed.db3")).events, pass_over(folder.path("plain.db3")).events);
}

TEST(Rosbag2, OneOfSeveralLasersIsChosen) {
  const TempFolder folder;
  auto messages = messages_of(sample_scans(2, 20), "/front/scan");
  for (auto& message : messages_of(sample_scans(3, 20), "/rear/scan")) messages.push_back(message);
  write_bag2(folder.path("bag.db3"), messages);
  EXPECT_THAT(refusal(folder.path("bag.db3")), HasSubstr("/front/scan (2 scans), /rear/scan (3 scans)"));
  EXPECT_THAT(pass_over(folder.path("bag.db3"), {.topic = "rear/scan"}).scans, SizeIs(3));
}

TEST(Rosbag2, TheFixedFramesTellWhereTheLaserSits) {
  const TempFolder folder;
  auto messages = messages_of(sample_scans(2, 20));  // in base_laser_link
  messages.push_back(
      {0, "/tf_static", kTfType, cdr_of({fixed("shell", "base_laser_link", {0.5, 0.0, 0.1}, 0.5 * kPi)})});
  messages.push_back({1, "/tf_static", kTfType,
                      cdr_of({fixed("base_link", "shell", {0.0, 1.0, 0.1}, 0.5 * kPi),
                              fixed("base_footprint", "base_link", {9.0, 0.0, 0.0}, 0.0)})});
  write_bag2(folder.path("bag.db3"), messages);
  auto recording = io::open_recording(folder.path("bag.db3")).value();
  ASSERT_TRUE(recording.laser_place());
  EXPECT_EQ(recording.laser_place()->told_by, "/tf_static, base_link -> base_laser_link");
  EXPECT_NEAR(recording.laser_place()->base_from_laser.x_m, 0.0, 1e-12);
  EXPECT_NEAR(recording.laser_place()->base_from_laser.y_m, 1.5, 1e-12);
  EXPECT_NEAR(std::abs(recording.laser_place()->base_from_laser.theta_rad), kPi, 1e-9);

  // The base is what odometry moves.
  messages.push_back({2, "/tf", kTfType, cdr_of({fixed("odom", "base_footprint", {0.0, 0.0, 0.0}, 0.0)})});
  write_bag2(folder.path("odom.db3"), messages);
  recording = io::open_recording(folder.path("odom.db3")).value();
  EXPECT_NEAR(recording.laser_place().value().base_from_laser.x_m, 9.0, 1e-12);
}

TEST(Rosbag2, ALaserThatHangsUpsideDownHasNoPlaceAndThatIsSaid) {
  const TempFolder folder;
  auto messages = messages_of(sample_scans(2, 20));
  messages.push_back(
      {0, "/tf_static", kTfType, cdr_of({fixed("base_link", "base_laser_link", {0.0, 0.0, 0.0}, 0.0, kPi)})});
  write_bag2(folder.path("bag.db3"), messages);
  EXPECT_FALSE(io::open_recording(folder.path("bag.db3"))->laser_place());
  const Pass pass = pass_over(folder.path("bag.db3"));
  ASSERT_THAT(pass.problems, SizeIs(1));
  EXPECT_THAT(pass.problems[0].what, HasSubstr("upside down"));
}

TEST(Rosbag2, FramesInARingEnd) {
  const TempFolder folder;
  auto messages = messages_of(sample_scans(1, 20));
  messages.push_back({0, "/tf_static", kTfType,
                      cdr_of({fixed("a", "base_laser_link", {0.0, 0.0, 0.0}, 0.0),
                              fixed("base_laser_link", "a", {0.0, 0.0, 0.0}, 0.0)})});
  write_bag2(folder.path("bag.db3"), messages);
  EXPECT_FALSE(io::open_recording(folder.path("bag.db3"))->laser_place());
}

TEST(Rosbag2, ADamagedMessageIsNamedAndPassedOver) {
  const TempFolder folder;
  auto messages = messages_of(sample_scans(3, 20));
  messages[1].bytes.resize(40);
  write_bag2(folder.path("bag.db3"), messages);
  const Pass pass = pass_over(folder.path("bag.db3"));
  EXPECT_THAT(pass.scans, SizeIs(2));
  ASSERT_THAT(pass.problems, SizeIs(1));
  EXPECT_THAT(pass.problems[0].where, HasSubstr("/scan recorded at"));
}

TEST(Rosbag2, FilesThatAreNoWholeBagAreRefusedInWords) {
  const TempFolder folder;
  write_bag2(folder.path("bag.db3"), a_drive());
  const std::string bytes = folder.read("bag.db3");
  EXPECT_THAT(refusal(folder.write("cut.db3", bytes.substr(0, bytes.size() - 4096))),
              HasSubstr("is cut: it has"));
  EXPECT_THAT(refusal(folder.write("short.db3", bytes.substr(0, 60))), HasSubstr("is cut"));

  folder.write("open.db3", bytes);
  folder.write("open.db3-wal", "the rest");
  EXPECT_THAT(refusal(folder.path("open.db3")), HasSubstr("was not closed by its recorder"));

  sqlite3* other = nullptr;
  sqlite3_open(folder.path("other.db3").c_str(), &other);
  run_sql(other, "CREATE TABLE songs(title TEXT)");
  sqlite3_close(other);
  EXPECT_THAT(refusal(folder.path("other.db3")), HasSubstr("not a ROS 2 bag"));

  sqlite3* writer = nullptr;
  sqlite3_open(folder.path("bag.db3").c_str(), &writer);
  run_sql(writer, "BEGIN EXCLUSIVE");
  EXPECT_THAT(refusal(folder.path("bag.db3")), HasSubstr("written to by another program"));
  run_sql(writer, "COMMIT");
  sqlite3_close(writer);
  EXPECT_EQ(refusal(folder.path("bag.db3")), "opened");
}

TEST(Rosbag2, AFileThatUnpacksToMoreThanThereIsRoomForIsRefused) {
  const TempFolder folder;
  write_bag2(folder.path("bag.db3"), a_drive());
  const std::string bytes = folder.read("bag.db3");
  const std::string path = folder.write("bag.db3.zstd", zstd_of(bytes));
  EXPECT_TRUE(io::unpack_zstd_file(path, bytes.size()).ok());
  const auto refused = io::unpack_zstd_file(path, bytes.size() - 1);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("temporary folder can spare"));
  EXPECT_THAT(refused.error().remedy, HasSubstr("TMPDIR"));
}

/// Zeros behind what a bag begins with, in frames of which only the first tells its size.
std::string zstd_bomb(std::size_t bytes) {
  constexpr std::size_t kFrame = std::size_t{8} << 20U;
  std::string packed = zstd_of(std::string("SQLite format 3\0", 16));
  const std::string zeros = zstd_of(std::string(kFrame, '\0'));
  for (std::size_t i = 0; i < bytes / kFrame; ++i) packed += zeros;
  return packed;
}

TEST(Rosbag2, AFileThatUnpacksToAbsurdlyMuchIsRefused) {
  const TempFolder folder;
  EXPECT_THAT(refusal(folder.write("small.db3.zstd", zstd_bomb(8U << 20U))), HasSubstr("not a database"));
  EXPECT_THAT(refusal(folder.write("bomb.db3.zstd", zstd_bomb(1U << 30U))), HasSubstr("1000 times its size"));
}

TEST(Rosbag2, TablesThatComputeTheirMessagesAreRefused) {
  const TempFolder folder;
  sqlite3* database = nullptr;
  sqlite3_open(folder.path("bag.db3").c_str(), &database);
  run_sql(database,
          "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);"
          "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data AS "
          "(zeroblob(200000000)))");
  sqlite3_close(database);
  EXPECT_THAT(refusal(folder.path("bag.db3")), HasSubstr("computed, not recorded"));
}

TEST(Rosbag2, AFolderThatNamesAFileTooLongForTheSystemIsRefused) {
  const TempFolder folder;
  folder.write("metadata.yaml",
               "rosbag2_bagfile_information:\n  relative_file_paths: [" + std::string(300, 'x') + "]\n");
  const std::string metadata = folder.path("metadata.yaml");
  EXPECT_THAT(refusal(metadata.substr(0, metadata.rfind('/'))), HasSubstr("is not there"));
}

TEST(Rosbag2, ABagThatWasClosedInWalModeIsReadWithoutMakingFiles) {
  const TempFolder folder;
  write_bag2(folder.path("a #1?.db3"), a_drive());
  sqlite3* database = nullptr;
  sqlite3_open(folder.path("a #1?.db3").c_str(), &database);
  run_sql(database, "PRAGMA journal_mode=WAL");
  run_sql(database, "DELETE FROM messages WHERE id = 1");
  sqlite3_close(database);
  EXPECT_THAT(pass_over(folder.path("a #1?.db3")).scans, SizeIs(2));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a #1?.db3-wal")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a #1?.db3-shm")));
}

TEST(Rosbag2, MutatedBagsEndInWordsNotInACrash) {
  const TempFolder folder;
  auto messages = a_drive();
  messages.push_back(
      {0, "/tf_static", kTfType, cdr_of({fixed("base_link", "base_laser_link", {0.0, 0.0, 0.0}, 0.0)})});
  write_bag2(folder.path("bag.db3"), messages);
  const std::string bytes = folder.read("bag.db3");
  Rng rng(11);
  int opened = 0;
  for (int i = 0; i < 400; ++i) {
    std::string mutated = bytes;
    for (int k = 0; k < 1 + i % 30; ++k)
      mutated[16 + rng.bits() % (bytes.size() - 16)] = static_cast<char>(rng.bits());
    opened += refusal(folder.write("mutated.db3", mutated)) == "opened" ? 1 : 0;
  }
  EXPECT_GT(opened, 20);  // else nothing behind the header was tried
}

TEST(Rosbag2, ATurtlebotsBagIsReadWhole) {
  const std::string path = recorded("turtlebot4/macfirst_floor_take_2");
  if (path.empty()) GTEST_SKIP() << "no recordings here";
  const Pass pass = pass_over(path);
  ASSERT_FALSE(pass.error) << *pass.error;
  EXPECT_THAT(pass.problems, IsEmpty());
  ASSERT_THAT(pass.scans, SizeIs(357));  // as metadata.yaml counts them
  EXPECT_EQ(pass.scans.front().size(), 720U);
  EXPECT_EQ(pass.events, pass_over(path + "/macfirst_floor_take_2_0.db3").events);
  std::size_t wheels = 0;
  for (const Odometry& odometry : pass.odometry) wheels += odometry.source == "/odom" ? 1 : 0;
  EXPECT_EQ(wheels, 920U);
  const auto recording = io::open_recording(path).value();
  ASSERT_TRUE(recording.laser_place());
  EXPECT_NEAR(recording.laser_place()->base_from_laser.theta_rad, 0.5 * kPi, 1e-3);
}

}  // namespace
}  // namespace beaconless
