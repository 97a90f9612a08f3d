// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// A picture in 256 shades, row-major from the upper left pixel; colours are averaged.
struct GrayImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> shades;   ///< width x height; 0 black … 255 white
  std::vector<std::uint8_t> opacity;  ///< empty, or as many as shades: 0 transparent … 255 opaque

  friend bool operator==(const GrayImage&, const GrayImage&) = default;
};

/// The largest picture, and so the largest grid, that is read.
inline constexpr std::int64_t kMaxPixels = 100'000'000;

/// Reads a PGM (P2, P5) or PNG picture; the first bytes decide, not the name.
///
/// Errors: no such file, another format (BMP, JPEG, colour PNM are told apart), a size of zero, a size beyond
/// kMaxPixels or beyond what the file's bytes can hold (both before anything is allocated), a truncated file.
Result<GrayImage> read_image(const std::string& path);

/// Reads PGM: comments in the header, shades scaled from 0 … maxval (up to 65535) to 0 … 255.
///
/// Source: netpbm.sourceforge.net/doc/pgm.html. Differs: of several pictures in a file the first is read.
Result<GrayImage> read_pgm(const std::string& path);

/// Reads PNG of any kind, interlaced too; 16 bits are scaled to 8, gamma is left alone as in map_server.
Result<GrayImage> read_png(const std::string& path);

/// Writes PGM, P5.
Result<Done> write_pgm(const std::string& path, const GrayImage& image);

}  // namespace beaconless::io
