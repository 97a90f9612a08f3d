// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/io/ros_message_sink.hpp"
#include "beaconless/io/sqlite_handles.hpp"

namespace beaconless::io {

/// A topic of a ROS 2 bag that is being written.
struct Rosbag2Topic {
  std::string name;
  std::string type;  ///< "sensor_msgs/msg/LaserScan"
  bool is_latched = false;
  std::uint64_t messages = 0;
};

/// The settings of a publisher as rosbag2 notes them, YAML: reliable, and for latched ones transient local.
std::string rosbag2_qos(bool is_latched);

/// Writes one SQLite file of a ROS 2 bag, with the tables that every rosbag2 since Foxy reads.
///
/// One transaction per 5000 messages. There is no journal: a file that was not finished is worth nothing, so
/// write it under another name (PartFile). Source: rosbag2_storage_sqlite3 of Humble, schema version 2.
class Rosbag2Writer : public RosMessageSink {
 public:
  /// Writes over what is there. A path that cannot be written shows in `good()`.
  explicit Rosbag2Writer(const std::string& path);
  ~Rosbag2Writer() override;

  void write(const RosMessageOut& message) override;
  bool good() const override { return why_.empty(); }
  std::string finish() override;

  const std::vector<Rosbag2Topic>& topics() const { return topics_; }
  std::int64_t start_ns() const { return start_ns_; }  ///< of the first message; 0 without any
  std::int64_t end_ns() const { return end_ns_; }      ///< of the last

 private:
  using Statement = SqliteStatement;

  void run(const char* sql);
  Statement prepare(const char* sql);
  void check(bool is_good);
  std::int64_t topic_id(const RosMessageOut& message);

  std::string why_;  ///< nothing more is written
  SqliteHandle database_;
  Statement insert_;
  std::vector<Rosbag2Topic> topics_;
  std::uint64_t messages_ = 0;
  std::int64_t start_ns_ = 0;
  std::int64_t end_ns_ = 0;
};

}  // namespace beaconless::io
