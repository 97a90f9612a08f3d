// SPDX-License-Identifier: Apache-2.0
// Writes small sound files of every kind that is fuzzed.
// usage: make_seeds FOLDER, which gets a folder a reader
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "beaconless/io/carmen_writer.hpp"
#include "beaconless/io/estimates_csv.hpp"
#include "beaconless/io/last_pose.hpp"
#include "beaconless/io/rostopic_echo.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/io/whole_file.hpp"

#include "tests/io/cdr_writer.hpp"
#include "tests/io/mcap_samples.hpp"
#include "tests/io/picture_bytes.hpp"
#include "tests/io/rosbag2_writer.hpp"

#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
#include "tests/io/rosbag1_writer.hpp"
#endif

namespace beaconless {
namespace {

namespace fs = std::filesystem;

class Seeds {
 public:
  explicit Seeds(fs::path root) : root_(std::move(root)) {}

  std::string path(const std::string& reader, const std::string& name) const {
    fs::create_directories(root_ / reader);
    return (root_ / reader / name).string();
  }
  void add(const std::string& reader, const std::string& name, const std::string& bytes) const {
    if (!io::write_whole_file(path(reader, name), bytes)) std::exit(1);
  }

 private:
  fs::path root_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

std::string text_of(const MessageBytes& bytes) { return {bytes.begin(), bytes.end()}; }

const Odometry kOdometry{Stamp{1'500'000'000'000'000'000}, {1.0, 2.0, 0.5}, Twist2{0.1, 0.2, 0.3}, ""};
const ReferencePose kPose{Stamp{1'500'000'000'100'000'000}, {1.0, 2.0, 0.5}, std::nullopt, ""};

std::vector<io::FrameTransform> transforms(const std::string& parent, const std::string& child) {
  return {{Stamp{1'500'000'000'000'000'000}, parent, child, {0.1, 0.2, 0.3}, Eigen::Quaterniond::Identity()}};
}

void text_logs(const Seeds& seeds, const std::vector<RawScan>& scans) {
  for (const char* name : {"log", "log.gz"}) {
    io::CarmenWriter writer(seeds.path("carmen", name));
    for (const RawScan& scan : scans) {
      writer.write(scan, {1.0, 2.0, 3.0}, {0.1, 0.0, 0.0});
      writer.write(scan);
      writer.write(kOdometry);
      writer.write(kPose);
    }
  }
  seeds.add("carmen", "old.log",
            "# old\nPARAM robot_frontlaser_offset 0.25\nFLASER 4 1 2 3 81.9 0 0 0 1 2 3 1.5 host 1.5\n"
            "ODOM 1 2 0.5 0 0 0 1.6 host 1.6\nRLASER 2 1 2 0 0 0 1 2 3 1.7 host 1.7\nTRUEPOS 1 2 3 1 2 3 1.8 "
            "h 1.8\n"
            "ROBOTLASER1 0 -1.57 3.14 0.0174 80 0.01 0 3 1 2 3 1 0.5 1 2 0 1 2 0 0 0 0 0 0 1.9 host 1.9\n"
            "RAWLASER1 0 -1.57 3.14 0.0174 80 0.01 0 3 1 2 3 0 1.95 host 1.95\nSYNC x\n");
  if (!io::write_rostopic_echo(seeds.path("echo", "scans"), scans)) std::exit(1);
  seeds.add(
      "echo", "odometry",
      "header:\n  seq: 1\n  stamp:\n    secs: 15\n    nsecs: 3\n  frame_id: \"odom\"\nchild_frame_id: base\n"
      "pose:\n  pose:\n    position:\n      x: 1.0\n      y: 2.0\n      z: 0.0\n    orientation:\n      x: "
      "0.0\n"
      "      y: 0.0\n      z: 0.0\n      w: 1.0\n  covariance: [0.0, 1.0]\ntwist:\n  twist:\n    linear:\n"
      "      x: 0.5\n      y: 0.0\n      z: 0.0\n    angular:\n      x: 0.0\n      y: 0.0\n      z: "
      "0.1\n---\n"
      "header:\n  stamp:\n    sec: 15\n    nanosec: 3\n  frame_id: map\npose:\n  position:\n    x: .nan\n"
      "    y: 2.0\n    z: 0.0\n  orientation:\n    x: 0.0\n    y: 0.0\n    z: 0.0\n    w: 1.0\n---\n");
  seeds.add("echo", "ros2",
            "header:\n  stamp:\n    sec: 1500000000\n    nanosec: 5\n  frame_id: laser\nangle_min: -1.5\n"
            "angle_max: 1.5\nangle_increment: 0.5\ntime_increment: 0.0\nscan_time: 0.1\nrange_min: 0.1\n"
            "range_max: 30.0\nranges:\n- 1.0\n- .inf\n- .nan\n- '...'\nintensities: []\n---\n");
}

/// No checksums, so that what is changed at random gets past them.
std::string without_checksums(std::string bytes) {
  const auto zero = [&](std::size_t at) { bytes.replace(at, 4, 4, '\0'); };
  for (std::size_t at = 8; at + io::kMcapPrefixBytes < bytes.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, &bytes[at + 1], sizeof length);
    const auto op = static_cast<io::McapOp>(bytes[at]);
    const std::size_t content = at + io::kMcapPrefixBytes;
    if (op == io::McapOp::chunk) zero(content + 24);
    if (op == io::McapOp::data_end) zero(content);
    if (op == io::McapOp::footer) return zero(content + 16), bytes;
    at = content + length;
  }
  return bytes;
}

void mcap_files(const Seeds& seeds, const std::vector<RawScan>& scans) {
  for (const auto& layout : every_layout()) {
    const std::string path = seeds.path("mcap", name_of(layout));
    write_ros1_mcap(path, scans, layout);
    seeds.add("mcap", name_of(layout) + " unchecked", without_checksums(bytes_of(path)));
  }
  const std::string path = seeds.path("mcap", "ros2");
  io::McapWriter file(path, "ros2", {io::McapCompression::none, 1000, true});
  const auto put = [&](const char* topic, const char* type, const MessageBytes& bytes) {
    const auto channel = file.add_channel(topic, "cdr", {.name = type, .encoding = "ros2msg"});
    file.write(channel, 1, 1, text_of(bytes));
  };
  put("/tf_static", "tf2_msgs/msg/TFMessage", cdr_of(transforms("base_link", "base_laser_link")));
  put("/tf", "tf2_msgs/msg/TFMessage", cdr_of(transforms("odom", "base_link")));
  put("/odom", "nav_msgs/msg/Odometry", cdr_of(kOdometry));
  put("/scan", "sensor_msgs/msg/LaserScan", cdr_of(scans[0]));
  if (!file.finish()) std::exit(1);
  seeds.add("mcap", "ros2 unchecked", without_checksums(bytes_of(path)));
}

void bags(const Seeds& seeds, const std::vector<RawScan>& scans) {
  std::vector<Bag2Message> messages{
      {1, "/tf_static", "tf2_msgs/msg/TFMessage", cdr_of(transforms("base_link", "base_laser_link"))},
      {2, "/tf", "tf2_msgs/msg/TFMessage", cdr_of(transforms("odom", "base_link"))},
      {3, "/odom", "nav_msgs/msg/Odometry", cdr_of(kOdometry)},
      {4, "/pose", "geometry_msgs/msg/PoseStamped", cdr_of(kPose, 0)}};
  for (const RawScan& scan : scans)
    messages.push_back({scan.stamp.ns, "/scan", "sensor_msgs/msg/LaserScan", cdr_of(scan)});
  const std::string packed = zstd_of(text_of(messages.back().bytes));
  messages.push_back({9, "/scan", "sensor_msgs/msg/LaserScan", {packed.begin(), packed.end()}});
  for (const bool is_old : {true, false}) {
    const std::string name = is_old ? "old" : "new";
    const std::string path = seeds.path("rosbag2", name);
    fs::remove(path);
    write_bag2(path, messages, is_old);
    seeds.add("zstd", name, zstd_of(bytes_of(path)));
  }
#ifdef BEACONLESS_HAS_ROSBAG1_WRITER
  BagContent content;
  for (const RawScan& raw : scans)
    content.scans.push_back({raw.stamp.ns, raw.frame_id, raw.angle_min_rad, raw.angle_increment_rad,
                             raw.time_increment_s, raw.scan_time_s, raw.range_min_m, raw.range_max_m,
                             raw.ranges_m, raw.intensities});
  content.odometry.push_back({1'500'000'000'000'000'000, 1.0, 2.0, 3.0});
  content.transforms = content.poses = content.odometry;
  write_bag(seeds.path("rosbag1", "plain"), content, BagCompression::none);
  write_bag(seeds.path("rosbag1", "bz2"), content, BagCompression::bz2);
  write_bag(seeds.path("rosbag1", "lz4"), content, BagCompression::lz4);
#endif
}

void single_messages(const Seeds& seeds, const RawScan& scan) {
  const std::vector<MessageBytes> all{cdr_of(scan), cdr_of(kOdometry), cdr_of(kPose, 0), cdr_of(kPose, 36),
                                      cdr_of(transforms("odom", "base_link"))};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string cdr = text_of(all[i]);
    seeds.add("messages", "cdr" + std::to_string(i), static_cast<char>(8 + i) + cdr);
    // Without header, and with one number more in front, it is nearly what ROS 1 has.
    seeds.add("messages", "ros" + std::to_string(i),
              static_cast<char>(i) + std::string(i < 4 ? 4 : 0, '\0') + cdr.substr(4));
  }
  seeds.add("messages", "ros_scan", std::string(1, '\0') + ros1_bytes(scan));
}

void pictures(const Seeds& seeds) {
  for (int how = 0; how < 16; ++how) {
    const auto add = [&](const std::string& name, const std::string& bytes) {
      seeds.add("picture", name + std::to_string(how), static_cast<char>(how) + bytes);
    };
    add("p5", p5(4, 3, "\x01\x02\x64\xfe\xff\xcd............"));
    add("p2", "P2 # text\n2 2\n255\n0 254 205\n100 ");
    add("wide", p5(2, 1, "\x01\x02\x03\x04", 1000));
    add("gray", png({4, 2, 8, 0, 0}, std::string("\0abcd\0efgh", 10)));
    add("bits", png({4, 2, 2, 0, 0}, std::string("\0a\0e", 4)));
    add("palette",
        png({2, 1, 8, 3, 0}, std::string("\0\0\1", 3), png_chunk("PLTE", "abcdef") + png_chunk("tRNS", "a")));
    add("rgba", png({1, 1, 8, 6, 0}, std::string("\0abcd", 5)));
    add("interlaced", png({1, 1, 16, 4, 1}, std::string("\0abcd", 5)));
  }
}

void small_files(const Seeds& seeds, const fs::path& data) {
  const auto add = [&](char kind, const std::string& name, const std::string& bytes) {
    seeds.add("small_files", name, kind + bytes);
  };
  add(0, "grid",
      "image: none.pgm\nresolution: 0.05\norigin: [1.0, 2.0, 0.1]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\nmode: trinary\n");
  for (const auto& entry : fs::directory_iterator(data / "plans"))
    if (fs::file_size(entry) < 8000) add(0, entry.path().filename(), bytes_of(entry.path()));
  for (const auto& entry : fs::directory_iterator(data / "scenarios"))
    add(1, entry.path().filename(), bytes_of(entry.path()));
  add(2, "config", "duration_s: 3.5\nseed: 7\nlidar: {rate_hz: 10}\n");
  add(2, "config_anchors", "a: &a 1\nseed: *a\n");
  const std::string scratch = seeds.path("small_files", "scratch");
  PoseEstimate estimate;
  estimate.stamp = kPose.stamp;
  {
    io::EstimatesCsvWriter csv(scratch);
    csv.write(estimate);
    csv.write(estimate);
  }
  add(3, "csv", bytes_of(scratch));
  add(4, "tum", "# t x y z qx qy qz qw\n1.5 1 2 0 0 0 0 1\n1305031098.6659 1.3 0.6 1.6 0.6 0.6 -0.3 -0.2\n");
  add(5, "relations", "1.5 2.5 1 2 0 0 0 0.5\n2.5 3.5 1 2 0 0 0 -3.1\n");
  if (!io::write_last_pose(scratch, io::last_pose_of(estimate, {}))) std::exit(1);
  add(6, "last_pose", bytes_of(scratch));
  estimate.status = Status::ok;
  estimate.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  if (!io::write_last_pose(scratch, io::last_pose_of(estimate, {}))) std::exit(1);
  add(6, "last_pose_ok", bytes_of(scratch));
  fs::remove(scratch);
  add(7, "metadata",
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
      "  relative_file_paths:\n    - bag_0.db3\n");
}

}  // namespace
}  // namespace beaconless

int main(int argc, char** argv) {
  using namespace beaconless;
  if (argc != 2) return std::cerr << "usage: make_seeds FOLDER\n", 2;
  const Seeds seeds{argv[1]};
  const auto scans = sample_scans(2, 12);
  text_logs(seeds, scans);
  mcap_files(seeds, scans);
  bags(seeds, scans);
  single_messages(seeds, scans[0]);
  pictures(seeds);
  small_files(seeds, fs::path(BEACONLESS_SOURCE_DIR) / "data");
}
