// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/zstd_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include <unistd.h>
#include <zstd.h>

#include "beaconless/io/packing.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

struct FreeStream {
  void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};

struct CloseFile {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};

using File = std::unique_ptr<std::FILE, CloseFile>;

/// Nine tenths of what is free: a robot whose disk is full has worse troubles than a bag that is not read.
std::uint64_t room_in(const std::filesystem::path& folder) {
  std::error_code unknown;
  const auto space = std::filesystem::space(folder, unknown);
  return unknown ? std::numeric_limits<std::uint64_t>::max() : space.available / 10 * 9;
}

/// Says why a file may not unpack to so many bytes, if so.
std::optional<Error> too_much(const std::string& path, std::uint64_t packed, std::uint64_t plain,
                              std::uint64_t room) {
  if (plain > room)
    return Error{path,
                 "cannot be unpacked: it has more than the " + std::to_string(room) +
                     " bytes that the temporary folder can spare",
                 "name a folder with more room in TMPDIR, or unpack it with `unzstd`"};
  if (is_absurd_packing(packed, plain))
    return Error{path, "unpacks to more than 1000 times its size, which no bag does",
                 "is it damaged? If you trust it, unpack it with `unzstd`"};
  return std::nullopt;
}

}  // namespace

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

Result<std::shared_ptr<const TemporaryFile>> unpack_zstd_file(const std::string& path,
                                                              std::optional<std::uint64_t> room_bytes) {
  std::error_code no_folder;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(no_folder);
  const auto packed_bytes = file_size_bytes(path);
  if (!packed_bytes) return packed_bytes.error();
  const std::uint64_t room = room_bytes ? *room_bytes : room_in(folder);
  std::string name = (folder / "beaconless-XXXXXX").string();
  const int descriptor = no_folder ? -1 : mkstemp(name.data());
  if (descriptor < 0)
    return Error{path, "cannot be unpacked: no file can be made in the temporary folder",
                 "name a folder that can be written in TMPDIR"};
  auto unpacked = std::make_shared<const TemporaryFile>(name);
  const File out(fdopen(descriptor, "wb"));
  std::ifstream in(path, std::ios::binary);
  const std::unique_ptr<ZSTD_DStream, FreeStream> stream(ZSTD_createDStream());
  std::vector<char> packed(ZSTD_DStreamInSize());
  std::vector<char> plain(ZSTD_DStreamOutSize());
  std::size_t wanted = 1;  // 0 between two frames, where a file may end
  std::uint64_t taken = 0;
  std::uint64_t given = 0;
  while (in.read(packed.data(), static_cast<std::streamsize>(packed.size())), in.gcount() > 0) {
    ZSTD_inBuffer from{packed.data(), static_cast<std::size_t>(in.gcount()), 0};
    if (const auto told = taken == 0 ? ZSTD_getFrameContentSize(from.src, from.size) : 0;
        told < ZSTD_CONTENTSIZE_ERROR)
      if (const auto error = too_much(path, *packed_bytes, told, room)) return *error;
    bool is_more = true;  // what was unpacked may wait for room
    while (from.pos < from.size || is_more) {
      ZSTD_outBuffer to{plain.data(), plain.size(), 0};
      wanted = ZSTD_decompressStream(stream.get(), &to, &from);
      if (ZSTD_isError(wanted) != 0)
        return Error{path + "@" + std::to_string(taken + from.pos),
                     std::string("the zstd data are damaged: ") + ZSTD_getErrorName(wanted), "copy it again"};
      given += to.pos;
      if (const auto error = too_much(path, *packed_bytes, given, room)) return *error;
      if (std::fwrite(plain.data(), 1, to.pos, out.get()) != to.pos)
        return Error{path, "cannot be unpacked: the temporary folder is full",
                     "name a folder with more room in TMPDIR, or unpack it with `unzstd`"};
      is_more = to.pos == to.size && wanted != 0;
    }
    taken += static_cast<std::uint64_t>(in.gcount());
  }
  if (wanted != 0)
    return Error{path + "@" + std::to_string(taken), "the zstd data end early: it was cut", "copy it again"};
  if (std::fflush(out.get()) != 0)
    return Error{path, "cannot be unpacked: the temporary folder is full", "name another in TMPDIR"};
  return unpacked;
}

std::string unpacked_zstd_head(std::string_view packed, std::size_t size) {
  std::string head(size, '\0');
  const std::unique_ptr<ZSTD_DStream, FreeStream> stream(ZSTD_createDStream());
  ZSTD_inBuffer from{packed.data(), packed.size(), 0};
  ZSTD_outBuffer to{head.data(), head.size(), 0};
  while (to.pos < to.size) {
    const std::size_t before = to.pos + from.pos;
    if (ZSTD_isError(ZSTD_decompressStream(stream.get(), &to, &from)) != 0 || to.pos + from.pos == before)
      break;
  }
  head.resize(to.pos);
  return head;
}

bool unpack_zstd(std::span<const unsigned char> packed, std::size_t limit, std::vector<unsigned char>& out) {
  const auto size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > limit) return false;
  out.resize(static_cast<std::size_t>(size));
  return ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()) == out.size();
}

}  // namespace beaconless::io
