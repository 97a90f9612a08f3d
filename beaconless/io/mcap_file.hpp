// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/mcap_reader.hpp"
#include "beaconless/io/mcap_records.hpp"

namespace beaconless::io {

/// A record of an MCAP file by its place.
struct McapRecord {
  McapOp op{};  ///< may be one that is not known
  std::uint64_t at = 0;
  std::uint64_t size = 0;  ///< of its content

  std::uint64_t content_at() const { return at + kMcapPrefixBytes; }
  std::uint64_t end() const { return content_at() + size; }
};

/// The bytes of an MCAP file, read by place. Every length is compared with the file's before it is believed.
class McapFile {
 public:
  using Bytes = std::vector<unsigned char>;

  explicit McapFile(const std::string& path);

  std::uint64_t size() const { return size_; }

  /// The record that begins at a byte; nothing where the file ends before the record does.
  std::optional<McapRecord> record_at(std::uint64_t at);

  /// The bytes from `at` on; false, and nothing allocated, where there are fewer.
  bool read(std::uint64_t at, std::uint64_t count, Bytes& bytes);

  /// The first bytes of a record's content, `most` or all there are.
  bool read_content(const McapRecord& record, std::uint64_t most, Bytes& bytes);

  /// Reads a chunk's header, and the byte at which the packed records begin.
  bool read_chunk(const McapRecord& record, McapChunk& chunk, std::uint64_t& packed_at);

  /// Reads, unpacks and checks the records of a chunk into `records`.
  /// Errors: with the chunk's byte in words; see unpack_mcap_chunk; a checksum that does not match.
  Result<Done> unpack(const McapRecord& record, Bytes& records);

 private:
  std::ifstream in_;
  std::uint64_t size_ = 0;
  Bytes packed_;
};

/// Calls `use(op, content, at)` for the records that lie one behind the other in `bytes`, `at` being where
/// the record begins; false where one is cut short, after the whole ones were seen, or where `use` gives
/// false.
template <class Use>
bool for_each_mcap_record(std::span<const unsigned char> bytes, Use use) {
  McapReader in(bytes);
  while (!in.is_empty()) {
    const std::size_t at = in.taken();
    const auto op = in.take<McapOp>();
    const auto content = in.bytes(in.take<std::uint64_t>());
    if (!in.ok() || !use(op, content, at)) return false;
  }
  return true;
}

}  // namespace beaconless::io
