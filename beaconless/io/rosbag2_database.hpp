// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/ros_message.hpp"
#include "beaconless/io/sqlite_handles.hpp"

namespace beaconless::io {

/// One SQLite file of a ROS 2 bag, open for reading only.
class Rosbag2Database {
 public:
  /// Errors: not SQLite, cut, damaged, being written to, not closed by its recorder (a -wal or -journal
  /// beside it), without the tables of a bag.
  static Result<Rosbag2Database> open(const std::string& path);

  /// All topics with the count of their messages. Errors: the file is damaged. Cost: one look at each row.
  Result<std::vector<Topic>> topics();

  /// The messages of the topics named, by the time of their recording. Memory does not grow with the file.
  static Result<std::unique_ptr<RosMessageSource>> messages(const std::string& path,
                                                            const std::vector<std::string>& topics);

 private:
  using Statement = SqliteStatement;
  class Messages;

  /// A topic as the table has it.
  struct Row {
    std::int64_t id = 0;
    Topic topic;
    bool is_cdr = false;
  };

  Rosbag2Database(std::string path, SqliteHandle database)
      : path_(std::move(path)), database_(std::move(database)) {}
  Result<Statement> prepare(const std::string& sql) const;
  Result<std::vector<Row>> rows() const;
  Error damaged() const;

  std::string path_;
  SqliteHandle database_;
};

}  // namespace beaconless::io
