// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag1_survey.hpp"

#include <cstring>
#include <fstream>
#include <map>

#include <bzlib.h>
#include <roslz4/lz4s.h>

#include "beaconless/io/packing.hpp"

namespace beaconless::io {
namespace {

constexpr std::uint64_t kVersionLineBytes = 13;            // "#ROSBAG V2.0\n"
constexpr std::uint64_t kMaxHeaderBytes = 1U << 20U;       // real ones have some dozens
constexpr std::uint64_t kMaxDefinitionBytes = 16U << 20U;  // of a connection: the text of its message type
constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{512}
                                         << 20U;  // the default is 768 KiB, one message at least
constexpr std::size_t kMaxBroken = 100'000;
constexpr std::uint64_t kIndexEntryBytes = 12;  // seconds, nanoseconds, offset
constexpr const char* kReindex = "repair a copy with `rosbag reindex`";

/// What a record is, as its field `op` has it.
enum class Op : unsigned char {
  message = 2,
  file_header = 3,
  index = 4,
  chunk = 5,
  chunk_info = 6,
  connection = 7
};

using Bytes = std::vector<unsigned char>;
using Fields = std::map<std::string, std::string>;

template <class T>
T number_at(const unsigned char* bytes) {
  T value{};
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// `length name=value`, again and again.
bool parse_fields(const unsigned char* at, std::uint64_t size, Fields& fields) {
  while (size > 0) {
    if (size < 4) return false;
    const auto length = number_at<std::uint32_t>(at);
    at += 4, size -= 4;
    if (length > size) return false;
    const std::string field(reinterpret_cast<const char*>(at), length);
    const std::size_t equals = field.find('=');
    if (equals == std::string::npos) return false;
    fields[field.substr(0, equals)] = field.substr(equals + 1);
    at += length, size -= length;
  }
  return true;
}

template <class T>
bool take_number(const Fields& fields, const char* name, T& value) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != sizeof(T)) return false;
  value = number_at<T>(reinterpret_cast<const unsigned char*>(found->second.data()));
  return true;
}

bool has_op(const Fields& fields, Op op) {
  unsigned char value = 0;
  return take_number(fields, "op", value) && value == static_cast<unsigned char>(op);
}

struct Record {
  Fields fields;
  std::uint64_t data_at = 0;
  std::uint64_t data_size = 0;
  std::uint64_t end() const { return data_at + data_size; }
};

struct Chunk {
  std::uint64_t data_at = 0;
  std::uint64_t size = 0;  ///< unpacked
  bool is_plain = true;
  bool is_readable = true;
  Bytes unpacked;
};

class Surveyor {
 public:
  explicit Surveyor(const std::string& path) : in_(path, std::ios::binary) {
    in_.seekg(0, std::ios::end);
    const auto end = in_.tellg();
    size_ = end < 0 ? 0 : static_cast<std::uint64_t>(end);
  }

  BagSurvey run() {
    walk();
    for (const auto& [id, topic] : topics_) add(topic);
    return std::move(survey_);
  }

 private:
  void walk() {
    Record header;
    std::uint64_t index_at = 0;
    std::uint32_t connections = 0;
    std::uint32_t chunks = 0;
    if (!read_record(kVersionLineBytes, Op::file_header, header) ||
        !take_number(header.fields, "index_pos", index_at) ||
        !take_number(header.fields, "conn_count", connections) ||
        !take_number(header.fields, "chunk_count", chunks))
      return fail(kVersionLineBytes, "the header of the bag is damaged", kReindex);
    const auto encryptor = header.fields.find("encryptor");
    if (encryptor != header.fields.end() && !encryptor->second.empty())
      return fail(kVersionLineBytes, "the bag is encrypted", "decrypt it with `rosbag decrypt`");
    if (index_at == 0)
      return fail(kVersionLineBytes, "the bag has no index: its recording did not end properly", kReindex);
    if (index_at > size_) return fail(size_, "the bag ends before its index: it was cut", kReindex);

    std::uint64_t at = index_at;
    for (std::uint32_t i = 0; i < connections; ++i)
      if (!walk_connection(at)) return;
    for (std::uint32_t i = 0; i < chunks; ++i)
      if (!walk_chunk_info(at)) return;
  }

  bool walk_connection(std::uint64_t& at) {
    Record record;
    Bytes definition;
    Fields about;
    std::uint32_t id = 0;
    if (!read_record(at, Op::connection, record) || !take_number(record.fields, "conn", id) ||
        record.data_size > kMaxDefinitionBytes || !read(record.data_at, record.data_size, definition) ||
        !parse_fields(definition.data(), definition.size(), about))
      return fail(at, "a connection of the index is damaged or missing", kReindex), false;
    at = record.end();
    const BagTopic topic{record.fields["topic"], about["type"], 0};
    const auto [known, is_new] = topics_.emplace(id, topic);
    if (is_new || (known->second.name == topic.name && known->second.type == topic.type)) return true;
    return fail(record.data_at, "two topics of the index have the same number", kReindex), false;
  }

  bool walk_chunk_info(std::uint64_t& at) {
    Record info;
    std::uint64_t chunk_at = 0;
    std::uint32_t indexes = 0;
    if (!read_record(at, Op::chunk_info, info) || !take_number(info.fields, "chunk_pos", chunk_at) ||
        !take_number(info.fields, "count", indexes) || info.data_size != 8 * std::uint64_t{indexes})
      return fail(at, "a chunk's entry in the index is damaged or missing", kReindex), false;
    if (chunk_at < chunks_end_)  // chunks lie one after the other: none is unpacked twice
      return fail(at, "two chunks of the index overlap", kReindex), false;
    at = info.end();
    return walk_chunk(chunk_at, indexes);
  }

  bool walk_chunk(std::uint64_t at, std::uint32_t indexes) {
    Record record;
    std::uint32_t unpacked = 0;
    if (!read_record(at, Op::chunk, record) || !take_number(record.fields, "size", unpacked))
      return fail(at, "a chunk is damaged or missing", kReindex), false;
    if (unpacked > kMaxChunkBytes)
      return fail(at, "a chunk promises " + std::to_string(unpacked) + " bytes", kReindex), false;
    if (is_absurd_packing(record.data_size, unpacked))
      return fail(at, "a chunk promises more than 1000 times its size", kReindex), false;
    Chunk chunk;
    chunk.data_at = record.data_at;
    chunk.size = unpacked;
    const std::string& compression = record.fields["compression"];
    chunk.is_plain = compression == "none";
    if (chunk.is_plain ? unpacked != record.data_size : compression != "bz2" && compression != "lz4")
      return fail(at, "a chunk's header is damaged", kReindex), false;
    if (!chunk.is_plain) chunk.is_readable = unpack(record, compression == "bz2", chunk);
    std::uint64_t index_at = record.end();
    for (std::uint32_t i = 0; i < indexes; ++i)
      if (!walk_index(index_at, chunk)) return false;
    chunks_end_ = index_at;
    return true;
  }

  bool walk_index(std::uint64_t& at, const Chunk& chunk) {
    Record record;
    Bytes entries;
    std::uint32_t id = 0;
    std::uint32_t count = 0;
    if (!read_record(at, Op::index, record) || !take_number(record.fields, "conn", id) ||
        !take_number(record.fields, "count", count) || topics_.count(id) == 0 ||
        !read(record.data_at, kIndexEntryBytes * count, entries))
      return fail(at, "the index of a chunk is damaged or missing", kReindex), false;
    BagTopic& topic = topics_[id];
    topic.count += count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const unsigned char* entry = entries.data() + kIndexEntryBytes * i;
      if (is_message(chunk, id, number_at<std::uint32_t>(entry + 8))) continue;
      survey_.broken.insert({topic.name, std::int64_t{number_at<std::uint32_t>(entry)} * 1'000'000'000 +
                                             number_at<std::uint32_t>(entry + 4)});
      if (survey_.broken.size() > kMaxBroken)
        return fail(chunk.data_at, "too many messages are damaged", kReindex), false;
    }
    at =
        record.data_at + entries.size();  // as librosbag: older recorders wrote a length of 20 bytes an entry
    return true;
  }

  /// Whether a whole message record of this connection lies at `offset` of the chunk.
  bool is_message(const Chunk& chunk, std::uint32_t connection, std::uint64_t offset) {
    Bytes bytes;
    if (!chunk.is_readable || !peek(chunk, offset, 4, bytes)) return false;
    const auto header_size = number_at<std::uint32_t>(bytes.data());
    if (header_size > kMaxHeaderBytes || !peek(chunk, offset + 4, header_size + 4ULL, bytes)) return false;
    Fields fields;
    std::uint32_t id = 0;
    if (!parse_fields(bytes.data(), header_size, fields) || !has_op(fields, Op::message) ||
        !take_number(fields, "conn", id) || id != connection)
      return false;
    const auto data_size = number_at<std::uint32_t>(bytes.data() + header_size);
    return offset + 8 + header_size + data_size <= chunk.size;
  }

  bool peek(const Chunk& chunk, std::uint64_t offset, std::uint64_t count, Bytes& bytes) {
    if (offset > chunk.size || count > chunk.size - offset) return false;
    if (chunk.is_plain) return read(chunk.data_at + offset, count, bytes);
    const auto first = chunk.unpacked.begin() + static_cast<std::ptrdiff_t>(offset);
    bytes.assign(first, first + static_cast<std::ptrdiff_t>(count));
    return true;
  }

  bool unpack(const Record& record, bool is_bz2, Chunk& chunk) {
    Bytes packed;
    if (record.data_size > kMaxChunkBytes || !read(record.data_at, record.data_size, packed)) return false;
    chunk.unpacked.resize(chunk.size);
    auto* from = reinterpret_cast<char*>(packed.data());
    auto* to = reinterpret_cast<char*>(chunk.unpacked.data());
    auto size = static_cast<unsigned>(chunk.size);
    const auto packed_size = static_cast<unsigned>(packed.size());
    const bool ok = is_bz2 ? BZ2_bzBuffToBuffDecompress(to, &size, from, packed_size, 0, 0) == BZ_OK
                           : roslz4_buffToBuffDecompress(from, packed_size, to, &size) == ROSLZ4_OK;
    return ok && size == chunk.size;
  }

  bool read_record(std::uint64_t at, Op op, Record& record) {
    Bytes bytes;
    if (!read(at, 4, bytes)) return false;
    const auto header_size = number_at<std::uint32_t>(bytes.data());
    if (header_size > kMaxHeaderBytes || !read(at + 4, header_size + 4ULL, bytes)) return false;
    if (!parse_fields(bytes.data(), header_size, record.fields) || !has_op(record.fields, op)) return false;
    record.data_at = at + 8 + header_size;
    record.data_size = number_at<std::uint32_t>(bytes.data() + header_size);
    return op == Op::index ||
           record.end() <= size_;  // an index tells its own count of entries, see walk_index
  }

  bool read(std::uint64_t at, std::uint64_t count, Bytes& bytes) {
    if (at > size_ || count > size_ - at) return false;
    bytes.resize(count);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
    return static_cast<std::uint64_t>(in_.gcount()) == count;
  }

  void add(const BagTopic& topic) {  // several publishers of a topic are several connections
    for (BagTopic& known : survey_.topics)
      if (known.name == topic.name && known.type == topic.type) {
        known.count += topic.count;
        return;
      }
    survey_.topics.push_back(topic);
  }

  void fail(std::uint64_t byte, std::string what, const char* remedy) {
    survey_.failure = BagFailure{byte, std::move(what), remedy};
  }

  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::uint64_t chunks_end_ = 0;
  std::map<std::uint32_t, BagTopic> topics_;
  BagSurvey survey_;
};

}  // namespace

BagSurvey survey_rosbag1(const std::string& path) { return Surveyor(path).run(); }

}  // namespace beaconless::io
