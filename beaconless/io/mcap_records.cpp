// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_records.hpp"

#include <zlib.h>

#include "beaconless/io/byte_writer.hpp"
#include "beaconless/io/mcap_reader.hpp"

namespace beaconless::io {
namespace {

/// Puts opcode and length before what is written while it lives.
class Record {
 public:
  Record(std::string& out, McapOp op) : out_(out), put(out) {
    put.put(op);
    length_at_ = out.size();
    put.put(std::uint64_t{0});
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;
  ~Record() { patch(length_at_, static_cast<std::uint64_t>(out_.size() - length_at_ - 8)); }

  /// What `fill` puts, behind the uint32 count of its bytes.
  template <class Fill>
  void list(Fill fill) {
    const std::size_t count_at = out_.size();
    put.put(std::uint32_t{0});
    fill();
    patch(count_at, static_cast<std::uint32_t>(out_.size() - count_at - 4));
  }

 private:
  template <class T>
  void patch(std::size_t at, T value) {
    std::memcpy(out_.data() + at, &value, sizeof(value));
  }

  std::string& out_;
  std::size_t length_at_;

 public:
  ByteWriter put;
};

}  // namespace

bool parse(std::span<const unsigned char> content, McapHeader& header) {
  McapReader in(content);
  header.profile = in.text();
  header.library = in.text();
  return in.ok();
}

bool parse(std::span<const unsigned char> content, McapSchema& schema) {
  McapReader in(content);
  schema.id = in.take<std::uint16_t>();
  schema.name = in.text();
  schema.encoding = in.text();
  schema.text = in.text();
  return in.ok() && schema.id != 0;
}

bool parse(std::span<const unsigned char> content, McapChannel& channel) {
  McapReader in(content);
  channel.id = in.take<std::uint16_t>();
  channel.schema_id = in.take<std::uint16_t>();
  channel.topic = in.text();
  channel.message_encoding = in.text();
  in.bytes(in.take<std::uint32_t>());  // metadata: nothing that changes how a message is read
  return in.ok();
}

bool parse(std::span<const unsigned char> content, McapMessage& message) {
  McapReader in(content);
  message.channel_id = in.take<std::uint16_t>();
  message.sequence = in.take<std::uint32_t>();
  message.log_ns = in.take<std::uint64_t>();
  message.publish_ns = in.take<std::uint64_t>();
  message.data = in.rest();
  return in.ok();
}

bool parse(std::span<const unsigned char> content, McapChunk& chunk) {
  McapReader in(content);
  chunk.start_ns = in.take<std::uint64_t>();
  chunk.end_ns = in.take<std::uint64_t>();
  chunk.unpacked_size = in.take<std::uint64_t>();
  chunk.unpacked_crc = in.take<std::uint32_t>();
  chunk.compression = in.text();
  chunk.packed_size = in.take<std::uint64_t>();
  return in.ok();
}

bool parse(std::span<const unsigned char> content, McapStatistics& statistics) {
  McapReader in(content);
  statistics.messages = in.take<std::uint64_t>();
  statistics.schemas = in.take<std::uint16_t>();
  statistics.channels = in.take<std::uint32_t>();
  in.bytes(2 * sizeof(std::uint32_t));  // attachments, metadata
  statistics.chunks = in.take<std::uint32_t>();
  statistics.start_ns = in.take<std::uint64_t>();
  statistics.end_ns = in.take<std::uint64_t>();
  McapReader counts(in.bytes(in.take<std::uint32_t>()));
  while (!counts.is_empty() && counts.ok()) {
    const auto channel = counts.take<std::uint16_t>();
    statistics.channel_messages.emplace_back(channel, counts.take<std::uint64_t>());
  }
  return in.ok() && counts.ok();
}

bool parse(std::span<const unsigned char> content, McapFooter& footer) {
  McapReader in(content);
  footer.summary_at = in.take<std::uint64_t>();
  footer.summary_offsets_at = in.take<std::uint64_t>();
  footer.summary_crc = in.take<std::uint32_t>();
  return in.ok();
}

void append(std::string& out, const McapHeader& header) {
  Record record(out, McapOp::header);
  record.put.text(header.profile);
  record.put.text(header.library);
}

void append(std::string& out, const McapSchema& schema) {
  Record record(out, McapOp::schema);
  record.put.put(schema.id);
  record.put.text(schema.name);
  record.put.text(schema.encoding);
  record.put.text(schema.text);
}

void append(std::string& out, const McapChannel& channel) {
  Record record(out, McapOp::channel);
  record.put.put(channel.id);
  record.put.put(channel.schema_id);
  record.put.text(channel.topic);
  record.put.text(channel.message_encoding);
  record.put.put(std::uint32_t{0});  // metadata
}

void append(std::string& out, const McapMessage& message) {
  Record record(out, McapOp::message);
  record.put.put(message.channel_id);
  record.put.put(message.sequence);
  record.put.put(message.log_ns);
  record.put.put(message.publish_ns);
  record.put.bytes({reinterpret_cast<const char*>(message.data.data()), message.data.size()});
}

void append(std::string& out, const McapChunk& chunk, std::string_view packed) {
  Record record(out, McapOp::chunk);
  record.put.put(chunk.start_ns);
  record.put.put(chunk.end_ns);
  record.put.put(chunk.unpacked_size);
  record.put.put(chunk.unpacked_crc);
  record.put.text(chunk.compression);
  record.put.put(static_cast<std::uint64_t>(packed.size()));
  record.put.bytes(packed);
}

void append(std::string& out, const McapMessageIndex& index) {
  Record record(out, McapOp::message_index);
  record.put.put(index.channel_id);
  record.list([&] {
    for (const auto& [log_ns, at] : index.entries) {
      record.put.put(log_ns);
      record.put.put(at);
    }
  });
}

void append(std::string& out, const McapChunkIndex& index) {
  Record record(out, McapOp::chunk_index);
  record.put.put(index.chunk.start_ns);
  record.put.put(index.chunk.end_ns);
  record.put.put(index.chunk_at);
  record.put.put(index.chunk_length);
  record.list([&] {
    for (const auto& [channel, at] : index.message_index_at) {
      record.put.put(channel);
      record.put.put(at);
    }
  });
  record.put.put(index.message_index_length);
  record.put.text(index.chunk.compression);
  record.put.put(index.chunk.packed_size);
  record.put.put(index.chunk.unpacked_size);
}

void append(std::string& out, const McapStatistics& statistics) {
  Record record(out, McapOp::statistics);
  record.put.put(statistics.messages);
  record.put.put(statistics.schemas);
  record.put.put(statistics.channels);
  record.put.put(std::uint32_t{0});  // attachments
  record.put.put(std::uint32_t{0});  // metadata
  record.put.put(statistics.chunks);
  record.put.put(statistics.start_ns);
  record.put.put(statistics.end_ns);
  record.list([&] {
    for (const auto& [channel, count] : statistics.channel_messages) {
      record.put.put(channel);
      record.put.put(count);
    }
  });
}

void append(std::string& out, const McapFooter& footer) {
  Record record(out, McapOp::footer);
  record.put.put(footer.summary_at);
  record.put.put(footer.summary_offsets_at);
  record.put.put(footer.summary_crc);
}

void append_data_end(std::string& out, std::uint32_t data_crc) {
  Record(out, McapOp::data_end).put.put(data_crc);
}

void append_summary_offset(std::string& out, McapOp group, std::uint64_t at, std::uint64_t length) {
  Record record(out, McapOp::summary_offset);
  record.put.put(group);
  record.put.put(at);
  record.put.put(length);
}

std::uint32_t mcap_crc(std::span<const unsigned char> bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

std::uint32_t mcap_crc(std::string_view bytes, std::uint32_t before) {
  return mcap_crc({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, before);
}

std::uint32_t joined_mcap_crc(std::uint32_t first, std::uint32_t second, std::uint64_t size) {
  return static_cast<std::uint32_t>(crc32_combine(first, second, static_cast<z_off_t>(size)));
}

}  // namespace beaconless::io
