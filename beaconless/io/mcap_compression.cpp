// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/mcap_compression.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <lz4frame.h>
#include <zstd.h>

#include "beaconless/io/packing.hpp"

namespace beaconless::io {
namespace {

using Bytes = std::span<const unsigned char>;

Error damaged(std::string_view compression) {
  return {"", "the chunk does not unpack as " + std::string(compression) + ": it is damaged", ""};
}

/// Calls `step(to, produced, over)`, which unpacks up to `produced` bytes and says how many, until it says
/// that all is out. False: it failed, came to a halt, or more or fewer than `size` bytes came.
template <class Step>
bool unpack_in_steps(std::uint64_t size, std::vector<unsigned char>& out, Step step) {
  constexpr std::uint64_t kStep = 128U << 10U;
  out.clear();
  for (bool over = false; !over;) {
    const std::size_t before = out.size();
    // One byte more than told, so that a frame that holds more is found out.
    out.resize(before + static_cast<std::size_t>(std::min(kStep, size - before + 1)));
    std::size_t produced = out.size() - before;
    const bool good = step(out.data() + before, produced, over);
    out.resize(before + produced);
    if (!good || out.size() > size || (produced == 0 && !over)) return false;
  }
  return out.size() == size;
}

bool unpack_lz4_chunk(Bytes packed, std::uint64_t size, std::vector<unsigned char>& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  return unpack_in_steps(size, out, [&](unsigned char* to, std::size_t& produced, bool& over) {
    std::size_t consumed = packed.size();
    const std::size_t left = LZ4F_decompress(context.get(), to, &produced, packed.data(), &consumed, nullptr);
    if (LZ4F_isError(left) != 0) return produced = 0, false;
    packed = packed.subspan(consumed);
    over = left == 0 && packed.empty();  // frames may follow one another
    return true;
  });
}

bool unpack_zstd_chunk(Bytes packed, std::uint64_t size, std::vector<unsigned char>& out) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> context(ZSTD_createDStream(),
                                                                           ZSTD_freeDStream);
  if (!context) throw std::bad_alloc();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  return unpack_in_steps(size, out, [&](unsigned char* to, std::size_t& produced, bool& over) {
    ZSTD_outBuffer space{to, produced, 0};
    const std::size_t left = ZSTD_decompressStream(context.get(), &space, &in);
    produced = space.pos;
    over = left == 0 && in.pos == in.size;
    return ZSTD_isError(left) == 0;
  });
}

}  // namespace

std::string_view to_string(McapCompression compression) {
  switch (compression) {
    case McapCompression::none:
      return "";
    case McapCompression::lz4:
      return "lz4";
    case McapCompression::zstd:
      return "zstd";
  }
  return "";
}

Result<Done> unpack_mcap_chunk(std::string_view compression, Bytes packed, std::uint64_t unpacked_size,
                               std::vector<unsigned char>& out) {
  if (unpacked_size > kMaxMcapChunkBytes)
    return Error{"",
                 "the chunk promises " + std::to_string(unpacked_size) + " bytes, more than the " +
                     std::to_string(kMaxMcapChunkBytes) + " that are unpacked at once",
                 ""};
  if (compression.empty()) {
    out.assign(packed.begin(), packed.end());
    if (out.size() == unpacked_size) return Done{};
    return Error{"", "the chunk is of another size than it says", ""};
  }
  if (compression != "lz4" && compression != "zstd")
    return Error{
        "", "the chunk is packed as '" + std::string(compression.substr(0, 20)) + "', known are lz4 and zstd",
        ""};
  if (is_absurd_packing(packed.size(), unpacked_size))
    return Error{"", "the chunk promises more than 1000 times its size", ""};
  if (packed.empty() && unpacked_size == 0) return out.clear(), Done{};
  const bool good = compression == "lz4" ? unpack_lz4_chunk(packed, unpacked_size, out)
                                         : unpack_zstd_chunk(packed, unpacked_size, out);
  if (!good) return damaged(compression);
  return Done{};
}

std::string pack_mcap_chunk(McapCompression compression, std::string_view records) {
  if (compression == McapCompression::none) return std::string(records);
  const bool is_lz4 = compression == McapCompression::lz4;
  std::string packed(
      is_lz4 ? LZ4F_compressFrameBound(records.size(), nullptr) : ZSTD_compressBound(records.size()), '\0');
  const std::size_t size =
      is_lz4
          ? LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr)
          : ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), ZSTD_CLEVEL_DEFAULT);
  if (is_lz4 ? LZ4F_isError(size) != 0 : ZSTD_isError(size) != 0) throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

}  // namespace beaconless::io
