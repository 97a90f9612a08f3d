// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_file.hpp"

#include <algorithm>

#include "beaconless/io/mcap_compression.hpp"

namespace beaconless::io {

McapFile::McapFile(const std::string& path) : in_(path, std::ios::binary) {
  in_.seekg(0, std::ios::end);
  const auto end = in_.tellg();
  if (end > 0) size_ = static_cast<std::uint64_t>(end);
}

bool McapFile::read(std::uint64_t at, std::uint64_t count, Bytes& bytes) {
  if (at > size_ || count > size_ - at) return false;
  bytes.resize(static_cast<std::size_t>(count));
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(at));
  in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  return static_cast<std::uint64_t>(in_.gcount()) == count;
}

std::optional<McapRecord> McapFile::record_at(std::uint64_t at) {
  Bytes prefix;
  if (!read(at, kMcapPrefixBytes, prefix)) return std::nullopt;
  McapReader in(prefix);
  McapRecord record{in.take<McapOp>(), at, in.take<std::uint64_t>()};
  if (record.size > size_ - record.content_at()) return std::nullopt;
  return record;
}

bool McapFile::read_content(const McapRecord& record, std::uint64_t most, Bytes& bytes) {
  return read(record.content_at(), std::min(record.size, most), bytes);
}

bool McapFile::read_chunk(const McapRecord& record, McapChunk& chunk, std::uint64_t& packed_at) {
  constexpr std::uint64_t kFixedBytes = 28 + 4 + 8;  // all but the compression's name
  constexpr std::uint64_t kLongestName = 64;
  Bytes head;
  if (!read_content(record, kFixedBytes + kLongestName, head) || !parse(head, chunk)) return false;
  packed_at = record.content_at() + kFixedBytes + chunk.compression.size();
  return packed_at <= record.end() && chunk.packed_size <= record.end() - packed_at;
}

Result<Done> McapFile::unpack(const McapRecord& record, Bytes& records) {
  McapChunk chunk;
  std::uint64_t packed_at = 0;
  if (!read_chunk(record, chunk, packed_at)) return Error{"", "the chunk's header is damaged", ""};
  if (chunk.packed_size > kMaxMcapChunkBytes)
    return Error{"", "the chunk is larger than any that is read", ""};
  if (!read(packed_at, chunk.packed_size, packed_)) return Error{"", "the chunk cannot be read", ""};
  if (auto unpacked = unpack_mcap_chunk(chunk.compression, packed_, chunk.unpacked_size, records); !unpacked)
    return unpacked.error();
  if (chunk.unpacked_crc != 0 && mcap_crc(records) != chunk.unpacked_crc)
    return Error{"", "the chunk's checksum does not match: it is damaged", ""};
  return Done{};
}

}  // namespace beaconless::io
