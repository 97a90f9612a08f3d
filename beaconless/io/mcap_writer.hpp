// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/mcap_compression.hpp"
#include "beaconless/io/mcap_records.hpp"

namespace beaconless::io {

/// How an MCAP file is laid out.
struct McapLayout {
  McapCompression compression = McapCompression::zstd;
  std::uint64_t chunk_bytes = 1U << 20U;  ///< unpacked, at which a chunk is closed; 0: no chunks
  bool has_summary = true;  ///< summary and indexes; without them readers walk through all of it
};

/// Writes an MCAP file message by message: chunks, message and chunk indexes, statistics, checksums.
///
/// What was written before a crash can be read up to the last whole chunk. Memory: one chunk, and 32 bytes a
/// chunk and topic. Source: mcap.dev/spec.
class McapWriter {
 public:
  /// Opens the file; a path that cannot be written shows in `good()`. Profile: "ros1", "ros2" or "".
  McapWriter(const std::string& path, std::string_view profile, const McapLayout& layout = {});
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;
  ~McapWriter() { static_cast<void>(finish()); }

  /// A topic; the schema is written once however many topics have it. At most 65535 of either.
  std::uint16_t add_channel(std::string_view topic, std::string_view message_encoding, McapSchema schema);

  /// Readers give messages in the order of `log_ns`.
  void write(std::uint16_t channel, std::uint64_t log_ns, std::uint64_t publish_ns, std::string_view data);

  bool good() const { return good_; }

  /// Writes what is left and the summary, closes the file, and says whether all of it has reached it. Called
  /// on destruction too.
  Result<Done> finish();

 private:
  void put(std::string_view bytes);
  void close_chunk();
  void put_summary();

  std::string path_;
  McapLayout layout_;
  std::ofstream out_;
  bool good_ = false;
  bool finished_ = false;
  std::uint64_t at_ = 0;      ///< bytes written
  std::uint32_t crc_ = 0;     ///< of all of them
  std::string records_;       ///< those of the open chunk
  McapChunk chunk_;           ///< its times
  std::size_t in_chunk_ = 0;  ///< messages
  std::map<std::uint16_t, McapMessageIndex> message_indexes_;
  std::vector<McapChunkIndex> chunk_indexes_;
  std::vector<McapSchema> schemas_;
  std::vector<McapChannel> channels_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  McapStatistics statistics_;
};

}  // namespace beaconless::io
