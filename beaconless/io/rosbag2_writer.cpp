// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag2_writer.hpp"

#include <algorithm>
#include <filesystem>

#include <sqlite3.h>

namespace beaconless::io {
namespace {

constexpr std::uint64_t kPerTransaction = 5000;

}  // namespace

std::string rosbag2_qos(bool is_latched) {
  constexpr const char* kNever = ":\n    sec: 9223372036\n    nsec: 854775807\n";
  return std::string("- history: 3\n  depth: 0\n  reliability: 1\n  durability: ") +
         (is_latched ? "1" : "2") + "\n  deadline" + kNever + "  lifespan" + kNever +
         "  liveliness: 1\n  liveliness_lease_duration" + kNever + "  avoid_ros_namespace_conventions: false";
}

Rosbag2Writer::Rosbag2Writer(const std::string& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  sqlite3* raw = nullptr;
  const int status = sqlite3_open_v2(
      path.c_str(), &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(raw);
  check(status == SQLITE_OK);
  run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN;"
      "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
      "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, "
      "data BLOB NOT NULL);"
      "CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  insert_ = prepare("INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)");
}

Rosbag2Writer::~Rosbag2Writer() = default;

void Rosbag2Writer::check(bool is_good) {
  if (!is_good && why_.empty())
    why_ = std::string("cannot be written; SQLite says: ") + sqlite3_errmsg(database_.get());
}

void Rosbag2Writer::run(const char* sql) {
  if (good()) check(sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK);
}

Rosbag2Writer::Statement Rosbag2Writer::prepare(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  if (good()) check(sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) == SQLITE_OK);
  return Statement(statement);
}

std::int64_t Rosbag2Writer::topic_id(const RosMessageOut& message) {
  auto known = std::find_if(topics_.begin(), topics_.end(), [&](const Rosbag2Topic& topic) {
    return topic.name == message.topic && topic.type == message.type;
  });
  if (known == topics_.end()) {
    topics_.push_back({std::string(message.topic), std::string(message.type), message.is_latched, 0});
    known = topics_.end() - 1;
    const std::string qos = rosbag2_qos(message.is_latched);
    if (const Statement add = prepare("INSERT INTO topics(name,type,serialization_format,"
                                      "offered_qos_profiles) VALUES(?,?,'cdr',?)")) {
      int column = 0;
      for (const std::string_view text :
           {std::string_view(known->name), std::string_view(known->type), std::string_view(qos)})
        sqlite3_bind_text(add.get(), ++column, text.data(), static_cast<int>(text.size()), nullptr);
      check(sqlite3_step(add.get()) == SQLITE_DONE);
    }
  }
  ++known->messages;
  return known - topics_.begin() + 1;
}

void Rosbag2Writer::write(const RosMessageOut& message) {
  if (!good()) return;
  const std::int64_t topic = topic_id(message);
  if (!good()) return;
  sqlite3_bind_int64(insert_.get(), 1, topic);
  sqlite3_bind_int64(insert_.get(), 2, message.recorded_ns);
  const bool is_bound =
      sqlite3_bind_blob64(insert_.get(), 3, message.bytes.data(), message.bytes.size(), nullptr) == SQLITE_OK;
  check(is_bound && sqlite3_step(insert_.get()) == SQLITE_DONE);
  sqlite3_reset(insert_.get());
  if (messages_ == 0) start_ns_ = message.recorded_ns;
  end_ns_ = message.recorded_ns;
  if (++messages_ % kPerTransaction == 0) run("COMMIT; BEGIN");
}

std::string Rosbag2Writer::finish() {
  if (!database_) return why_;
  run("COMMIT");
  insert_.reset();
  database_.reset();
  return why_;
}

}  // namespace beaconless::io
