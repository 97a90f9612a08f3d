// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

namespace beaconless {

/// The bytes of a P5 picture.
inline std::string p5(int width, int height, std::string_view shades, int maxval = 255) {
  return "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + std::to_string(maxval) +
         "\n" + std::string(shades);
}

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((value >> shift) & 0xFFU);
  return bytes;
}

/// One chunk of a PNG, with its checksum.
inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}

/// What a PNG says of itself.
struct PngKind {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int bit_depth = 8;
  int color_type = 0;  ///< 0 gray, 2 RGB, 3 palette, 4 gray + alpha, 6 RGBA
  int interlace = 0;
};

/// The bytes of a PNG whose rows (each the filter byte 0 and its pixels) are given as they are stored;
/// `extra` goes before the pixels.
inline std::string png(const PngKind& kind, const std::string& rows, const std::string& extra = "") {
  std::string header = big_endian(kind.width) + big_endian(kind.height);
  for (const int value : {kind.bit_depth, kind.color_type, 0, 0, kind.interlace})
    header += static_cast<char>(value);
  std::vector<Bytef> packed(compressBound(static_cast<uLong>(rows.size())));
  auto size = static_cast<uLongf>(packed.size());
  compress(packed.data(), &size, reinterpret_cast<const Bytef*>(rows.data()),
           static_cast<uLong>(rows.size()));
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + extra +
         png_chunk("IDAT", std::string(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size))) +
         png_chunk("IEND", "");
}

}  // namespace beaconless
