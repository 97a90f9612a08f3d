// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/png.hpp"

#include <algorithm>

#include <png.h>

namespace beaconless::report {

std::string encode_png(const IndexedImage& image) {
  if (image.width_px <= 0 || image.height_px <= 0 || image.palette.empty() || image.palette.size() > 256)
    return "";
  const std::size_t count =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.pixels.size() != count) return "";
  if (*std::max_element(image.pixels.begin(), image.pixels.end()) >= image.palette.size()) return "";

  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width_px);
  header.height = static_cast<png_uint_32>(image.height_px);
  header.format = PNG_FORMAT_RGBA_COLORMAP;
  header.colormap_entries = static_cast<png_uint_32>(image.palette.size());

  std::string file(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = file.size();
  const int written = png_image_write_to_memory(&header, file.data(), &size, 0, image.pixels.data(),
                                                image.width_px, image.palette.data());
  png_image_free(&header);
  file.resize(written != 0 ? size : 0);
  return file;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (std::size_t j = 0; j < 3; ++j)
      word = word << 8U | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? kLetters[word >> (18U - 6U * j) & 63U] : '=';
  }
  return text;
}

}  // namespace beaconless::report
