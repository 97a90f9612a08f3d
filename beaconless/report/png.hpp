// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace beaconless::report {

/// A picture of at most 256 colours, rows from the top.
struct IndexedImage {
  using Rgba = std::array<std::uint8_t, 4>;

  int width_px = 0;
  int height_px = 0;
  std::vector<Rgba> palette;
  std::vector<std::uint8_t> pixels;  ///< width x height positions in the palette
};

/// The bytes of a PNG file with 1, 2, 4 or 8 bits a pixel, as the palette needs; "" for an image that is
/// empty or whose sizes contradict each other.
std::string encode_png(const IndexedImage& image);

/// Source: RFC 4648, section 4.
std::string base64(std::string_view bytes);

}  // namespace beaconless::report
