// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <zstd.h>

#include "cdr_writer.hpp"

namespace beaconless {

struct Bag2Message {
  std::int64_t recorded_ns = 0;
  std::string topic;
  std::string type;  ///< "sensor_msgs/msg/LaserScan"
  MessageBytes bytes;
};

inline void run_sql(sqlite3* database, const std::string& sql) {
  char* said = nullptr;
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &said), SQLITE_OK) << said << ": " << sql;
  sqlite3_free(said);
}

/// Writes a bag's SQLite file as rosbag2 does in layouts that io::Rosbag2Writer does not write: that of Foxy
/// with `is_old`, else that of Jazzy; any bytes will do.
inline void write_bag2(const std::string& path, const std::vector<Bag2Message>& messages,
                       bool is_old = false) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  run_sql(database, "PRAGMA synchronous=OFF; BEGIN");
  if (is_old) {
    run_sql(database,
            "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
            "serialization_format TEXT NOT NULL)");
  } else {
    run_sql(
        database,
        "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY,ros_distro TEXT NOT NULL);"
        "INSERT INTO schema VALUES(4,'jazzy');"
        "CREATE TABLE metadata(id INTEGER PRIMARY KEY,metadata_version INTEGER NOT NULL,metadata TEXT NOT "
        "NULL);"
        "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
        "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL,"
        "type_description_hash TEXT NOT NULL)");
  }
  run_sql(
      database,
      "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, "
      "data BLOB NOT NULL)");
  if (!is_old) run_sql(database, "CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  std::vector<std::string> topics;
  sqlite3_stmt* insert = nullptr;
  ASSERT_EQ(sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)", -1,
                               &insert, nullptr),
            SQLITE_OK);
  for (const Bag2Message& message : messages) {
    auto known = std::find(topics.begin(), topics.end(), message.topic);
    if (known == topics.end()) {
      topics.push_back(message.topic);
      known = topics.end() - 1;
      run_sql(database, "INSERT INTO topics VALUES(" + std::to_string(topics.size()) + ",'" + message.topic +
                            "','" + message.type + "','cdr'" + (is_old ? ")" : ",'','')"));
    }
    sqlite3_bind_int64(insert, 1, known - topics.begin() + 1);
    sqlite3_bind_int64(insert, 2, message.recorded_ns);
    sqlite3_bind_blob(insert, 3, message.bytes.data(), static_cast<int>(message.bytes.size()), nullptr);
    EXPECT_EQ(sqlite3_step(insert), SQLITE_DONE);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  run_sql(database, "COMMIT");
  sqlite3_close(database);
}

inline std::string zstd_of(std::string_view bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
  return packed;
}

}  // namespace beaconless
