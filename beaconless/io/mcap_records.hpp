// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace beaconless::io {

/// The records of an MCAP file, one struct each, and the bytes that they are.
///
/// `parse` reads what stands behind a record's opcode and length, and gives false where a length inside tells
/// more than there is; bytes behind the last known field are passed over, as the format wants it. `append`
/// puts the whole record at the end of `out`. Times are nanoseconds. Source: mcap.dev/spec.
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

enum class McapOp : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// Before every record's content: an opcode of one byte and a length of eight.
inline constexpr std::uint64_t kMcapPrefixBytes = 9;

struct McapHeader {
  std::string profile;  ///< "ros1", "ros2", or nothing
  std::string library;
};

struct McapSchema {
  std::uint16_t id = 0;
  std::string name;      ///< "sensor_msgs/msg/LaserScan"
  std::string encoding;  ///< "ros2msg", "ros1msg"
  std::string text;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: none
  std::string topic;
  std::string message_encoding;  ///< "cdr", "ros1"
};

struct McapMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0;
  std::uint64_t publish_ns = 0;
  std::span<const unsigned char> data;  ///< a view
};

struct McapChunk {
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::uint64_t unpacked_size = 0;
  std::uint32_t unpacked_crc = 0;  ///< 0: not told
  std::string compression;         ///< "", "lz4", "zstd"
  std::uint64_t packed_size = 0;   ///< of the bytes that follow
};

/// One message of a chunk: when it was recorded, and at which unpacked byte its record begins.
using McapIndexEntry = std::pair<std::uint64_t, std::uint64_t>;

struct McapMessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<McapIndexEntry> entries;
};

struct McapChunkIndex {
  McapChunk chunk;
  std::uint64_t chunk_at = 0;
  std::uint64_t chunk_length = 0;  ///< of the whole record
  std::vector<std::pair<std::uint16_t, std::uint64_t>> message_index_at;
  std::uint64_t message_index_length = 0;
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start_ns = 0;
  std::uint64_t end_ns = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channel_messages;
};

struct McapFooter {
  std::uint64_t summary_at = 0;  ///< 0: there is none
  std::uint64_t summary_offsets_at = 0;
  std::uint32_t summary_crc = 0;  ///< 0: not told
};

/// Where the footer's own part of the summary's checksum ends: before the checksum itself.
inline constexpr std::uint64_t kMcapFooterCrcBytes = kMcapPrefixBytes + 16;
inline constexpr std::uint64_t kMcapFooterBytes = kMcapFooterCrcBytes + 4;

bool parse(std::span<const unsigned char> content, McapHeader& header);
bool parse(std::span<const unsigned char> content, McapSchema& schema);
bool parse(std::span<const unsigned char> content, McapChannel& channel);
bool parse(std::span<const unsigned char> content, McapMessage& message);
bool parse(std::span<const unsigned char> content, McapChunk& chunk);  ///< without the packed bytes
bool parse(std::span<const unsigned char> content, McapStatistics& statistics);
bool parse(std::span<const unsigned char> content, McapFooter& footer);

void append(std::string& out, const McapHeader& header);
void append(std::string& out, const McapSchema& schema);
void append(std::string& out, const McapChannel& channel);
void append(std::string& out, const McapMessage& message);
void append(std::string& out, const McapChunk& chunk, std::string_view packed);
void append(std::string& out, const McapMessageIndex& index);
void append(std::string& out, const McapChunkIndex& index);
void append(std::string& out, const McapStatistics& statistics);
void append(std::string& out, const McapFooter& footer);
void append_data_end(std::string& out, std::uint32_t data_crc);
void append_summary_offset(std::string& out, McapOp group, std::uint64_t at, std::uint64_t length);

/// The checksum of the format, CRC-32; goes on from `before`.
std::uint32_t mcap_crc(std::span<const unsigned char> bytes, std::uint32_t before = 0);
std::uint32_t mcap_crc(std::string_view bytes, std::uint32_t before = 0);
/// The checksum of bytes that are followed by others, `size` of them, from those of either.
std::uint32_t joined_mcap_crc(std::uint32_t first, std::uint32_t second, std::uint64_t size);

}  // namespace beaconless::io
