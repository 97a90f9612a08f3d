// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag2_database.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>

#include <sqlite3.h>

#include "beaconless/io/zstd_file.hpp"

namespace beaconless::io {
namespace {

constexpr int kMaxValueBytes = 64 << 20;  // a scan has some kilobytes; images are not read
constexpr std::size_t kMaxTopics = 10'000;
constexpr std::size_t kMaxTextBytes = 4096;
constexpr const char* kSave =  // Debian's sqlite3 has no .recover
    "save what is left with `sqlite3 FILE .dump | sed 's/^ROLLBACK.*/COMMIT;/' | sqlite3 NEW`";

std::uint64_t file_bytes(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

struct FileHeader {
  bool is_wal = false;
  bool tells_size = false;
  std::uint64_t bytes = 0;  ///< that the pages take
};

/// Source: sqlite.org/fileformat2.html, 1.3.
std::optional<FileHeader> read_header(const std::string& path) {
  std::array<unsigned char, 100> raw{};
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(raw.data()), raw.size());
  if (in.gcount() != static_cast<std::streamsize>(raw.size())) return std::nullopt;
  const auto word = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | raw[at + i];
    return value;
  };
  const std::uint64_t page = std::uint64_t{raw[16]} << 8U | raw[17];
  return FileHeader{raw[18] == 2 || raw[19] == 2, word(24) == word(92),
                    word(28) * (page == 1 ? 65536 : page)};
}

/// A path as SQLite takes it: `immutable` keeps it from making files beside one that was closed well.
std::string uri_of(const std::string& path, bool is_immutable) {
  constexpr const char* kHex = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '%' || c == '?' || c == '#')
      uri += std::string("%") + kHex[byte >> 4U] + kHex[byte & 15U];
    else
      uri += c;
  }
  return uri + (is_immutable ? "?mode=ro&immutable=1" : "?mode=ro");
}

std::string text_of(sqlite3_stmt* statement, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
  return text != nullptr ? std::string(text, std::min(size, kMaxTextBytes)) : std::string();
}

}  // namespace

/// Steps through the rows of the topics wanted.
class Rosbag2Database::Messages : public RosMessageSource {
 public:
  Messages(Rosbag2Database database, Statement statement, std::map<std::int64_t, Row> rows)
      : database_(std::move(database)), statement_(std::move(statement)), rows_(std::move(rows)) {}

  Step next(RosMessage& message) override {
    if (is_over_) return Step::end;
    const int step = sqlite3_step(statement_.get());
    if (step != SQLITE_ROW) {
      is_over_ = true;
      if (step != SQLITE_DONE) ended_by_ = to_string(database_.damaged());
      return Step::end;
    }
    const Row& row = rows_.at(sqlite3_column_int64(statement_.get(), 0));
    message.topic = row.topic.name;
    message.type = row.topic.type;
    message.is_cdr = row.is_cdr;
    message.recorded_ns = sqlite3_column_int64(statement_.get(), 1);
    const auto* bytes = static_cast<const unsigned char*>(sqlite3_column_blob(statement_.get(), 2));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), 2));
    if (bytes == nullptr || size == 0) return message.bytes.clear(), Step::broken;
    const std::span<const unsigned char> blob(bytes, size);
    const std::string_view head(reinterpret_cast<const char*>(bytes), std::min(size, kZstdMagic.size()));
    if (head == kZstdMagic)  // compression_mode: MESSAGE; no header of CDR begins like this
      return unpack_zstd(blob, kMaxValueBytes, message.bytes) ? Step::message : Step::broken;
    message.bytes.assign(blob.begin(), blob.end());
    return Step::message;
  }

  std::string ended_by() const override { return ended_by_; }

 private:
  Rosbag2Database database_;
  Statement statement_;
  std::map<std::int64_t, Row> rows_;
  std::string ended_by_;
  bool is_over_ = false;
};

Result<Rosbag2Database> Rosbag2Database::open(const std::string& path) {
  const auto header = read_header(path);
  if (!header) return Error{path, "is cut: it ends within the header of SQLite", "copy it again"};
  for (const char* suffix : {"-wal", "-journal"})
    if (file_bytes(path + suffix) > 0)
      return Error{path, "was not closed by its recorder: " + path + suffix + " holds a part of it",
                   "close the recorder, or bring copies of both up to date with `sqlite3 COPY 'PRAGMA "
                   "journal_mode=DELETE'`"};
  if (const auto size = file_bytes(path); header->tells_size && header->bytes > size)
    return Error{path,
                 "is cut: it has " + std::to_string(size) + " of " + std::to_string(header->bytes) + " bytes",
                 std::string("copy it again, or ") + kSave};
  sqlite3* raw = nullptr;
  const int status = sqlite3_open_v2(uri_of(path, header->is_wal).c_str(), &raw,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  Rosbag2Database database(path, SqliteHandle(raw));
  if (status != SQLITE_OK) return database.damaged();
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  // What a foreign file defines may not call functions.
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0,
                    nullptr);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  // Nor may a damaged page point past its end, where whatever was there before would be read.
  // Source: sqlite.org/security.html.
  sqlite3_exec(raw, "PRAGMA cell_size_check=ON", nullptr, nullptr, nullptr);
  const auto tables = database.prepare(
      "SELECT (SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('topics', 'messages') "
      "AND sql NOT LIKE 'CREATE VIRTUAL%'), (SELECT count(*) FROM pragma_table_xinfo('topics') WHERE hidden "
      "> 1) + (SELECT count(*) FROM pragma_table_xinfo('messages') WHERE hidden > 1)");
  if (!tables) return tables.error();
  if (sqlite3_step(tables->get()) != SQLITE_ROW) return database.damaged();
  if (sqlite3_column_int(tables->get(), 0) != 2)
    return Error{path, "is an SQLite database, but not a ROS 2 bag: it has no tables topics and messages",
                 ""};
  if (sqlite3_column_int(tables->get(), 1) != 0)  // a few bytes could then give any number of huge messages
    return Error{path, "is not a ROS 2 bag: its tables hold columns that are computed, not recorded", ""};
  return database;
}

Result<std::vector<Topic>> Rosbag2Database::topics() {
  auto rows = this->rows();
  if (!rows) return rows.error();
  const auto counts = prepare("SELECT topic_id, count(*) FROM messages GROUP BY topic_id");
  if (!counts) return counts.error();
  int step = SQLITE_ROW;
  while ((step = sqlite3_step(counts->get())) == SQLITE_ROW)
    for (Row& row : rows.value())
      if (row.id == sqlite3_column_int64(counts->get(), 0))
        row.topic.count =
            static_cast<std::uint64_t>(std::max<sqlite3_int64>(0, sqlite3_column_int64(counts->get(), 1)));
  if (step != SQLITE_DONE) return damaged();
  std::vector<Topic> topics;
  for (Row& row : rows.value()) topics.push_back(std::move(row.topic));
  return topics;
}

Result<std::unique_ptr<RosMessageSource>> Rosbag2Database::messages(const std::string& path,
                                                                    const std::vector<std::string>& topics) {
  auto database = open(path);
  if (!database) return database.error();
  auto all = database->rows();
  if (!all) return all.error();
  std::map<std::int64_t, Row> wanted;
  std::string ids;
  for (Row& row : all.value()) {
    if (!row.is_cdr || std::find(topics.begin(), topics.end(), row.topic.name) == topics.end()) continue;
    ids += (ids.empty() ? "" : ", ") + std::to_string(row.id);
    wanted[row.id] = std::move(row);
  }
  auto statement = database->prepare("SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN (" +
                                     ids + ") ORDER BY timestamp, id");
  if (!statement) return statement.error();
  return std::unique_ptr<RosMessageSource>(std::make_unique<Messages>(
      std::move(database).value(), std::move(statement).value(), std::move(wanted)));
}

Result<Rosbag2Database::Statement> Rosbag2Database::prepare(const std::string& sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
    return damaged();
  return Statement(statement);
}

Result<std::vector<Rosbag2Database::Row>> Rosbag2Database::rows() const {
  const auto statement = prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY name");
  if (!statement) return statement.error();
  std::vector<Row> rows;
  int step = SQLITE_ROW;
  while ((step = sqlite3_step(statement->get())) == SQLITE_ROW && rows.size() < kMaxTopics)
    rows.push_back({sqlite3_column_int64(statement->get(), 0),
                    {text_of(statement->get(), 1), text_of(statement->get(), 2), 0},
                    text_of(statement->get(), 3) == "cdr"});
  if (step != SQLITE_DONE && step != SQLITE_ROW) return damaged();
  return rows;
}

Error Rosbag2Database::damaged() const {
  const int code = sqlite3_errcode(database_.get());
  const std::string says = std::string("SQLite says: ") + sqlite3_errmsg(database_.get());
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED)
    return {path_, "is being written to by another program; " + says, "close it, or read a copy"};
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) return {path_, "is damaged; " + says, kSave};
  return {path_, "cannot be read as a ROS 2 bag; " + says, ""};
}

}  // namespace beaconless::io
