// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <csetjmp>
#include <cstdio>
#include <string_view>

#include <png.h>

#include "beaconless/io/gray_image.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

/// Deflate packs at most 1032 bytes into one; a file that promises more lies.
constexpr std::uint64_t kMaxPacking = 1032;

/// Everything that outlives a jump out of libpng; nothing with a destructor is born between setjmp and the
/// jump.
struct PngReading {
  std::FILE* file = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string what = "is not PNG";
  std::uint64_t size_bytes = 0;
  std::vector<png_byte> pixels;  ///< one row; all of them when interlaced
  std::vector<png_bytep> rows;
  std::size_t channels = 0;
  GrayImage image;

  PngReading() = default;
  PngReading(const PngReading&) = delete;
  PngReading& operator=(const PngReading&) = delete;
  ~PngReading() {
    if (png != nullptr) png_destroy_read_struct(&png, &info, nullptr);
    if (file != nullptr) std::fclose(file);
  }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  static_cast<PngReading*>(png_get_error_ptr(png))->what = std::string("is not PNG: ") + message;
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

/// Reads the header and asks for 8 bits a channel: gray, gray + alpha, RGB or RGBA.
bool read_header(PngReading& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;  // NOLINT(cert-err52-cpp): libpng knows no other way out
  png_init_io(r.png, r.file);
  png_read_info(r.png, r.info);
  png_set_palette_to_rgb(r.png);
  png_set_expand_gray_1_2_4_to_8(r.png);
  if (png_get_valid(r.png, r.info, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(r.png);
  png_set_scale_16(r.png);
  return true;
}

bool start(PngReading& r, int& passes) {
  if (setjmp(png_jmpbuf(r.png))) return false;  // NOLINT(cert-err52-cpp)
  passes = png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  r.channels = png_get_channels(r.png, r.info);
  return true;
}

bool read_row(PngReading& r, png_bytep row) {
  if (setjmp(png_jmpbuf(r.png))) return false;  // NOLINT(cert-err52-cpp)
  png_read_row(r.png, row, nullptr);
  return true;
}

bool read_all(PngReading& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;  // NOLINT(cert-err52-cpp)
  png_read_image(r.png, r.rows.data());
  return true;
}

void keep_row(PngReading& r, const png_byte* row, std::size_t y) {
  const auto width = static_cast<std::size_t>(r.image.width_px);
  const std::size_t colors = r.channels >= 3 ? 3 : 1;
  for (std::size_t x = 0; x < width; ++x, row += r.channels) {
    const unsigned sum = colors == 3 ? static_cast<unsigned>(row[0]) + row[1] + row[2] : row[0];
    r.image.shades[y * width + x] = static_cast<std::uint8_t>((sum + colors / 2) / colors);
    if (r.channels != colors) r.image.opacity[y * width + x] = row[colors];
  }
}

bool read_pixels(PngReading& r) {
  int passes = 0;
  if (!start(r, passes)) return false;
  const auto width = static_cast<std::size_t>(r.image.width_px);
  const auto height = static_cast<std::size_t>(r.image.height_px);
  const std::size_t row_bytes = width * r.channels;
  r.image.shades.resize(width * height);
  if (r.channels % 2 == 0) r.image.opacity.resize(width * height);
  if (passes == 1) {
    r.pixels.resize(row_bytes);
    for (std::size_t y = 0; y < height; ++y) {
      if (!read_row(r, r.pixels.data())) return false;
      keep_row(r, r.pixels.data(), y);
    }
    return true;
  }
  r.pixels.resize(row_bytes * height);
  for (std::size_t y = 0; y < height; ++y) r.rows.push_back(r.pixels.data() + y * row_bytes);
  if (!read_all(r)) return false;
  for (std::size_t y = 0; y < height; ++y) keep_row(r, r.rows[y], y);
  return true;
}

/// Where a chunk leads past the end of the file, if one does: libpng would make room for all of it before it
/// reads. Source: PNG specification, 5.3 (chunk layout).
std::string cut_chunk(const PngReading& r) {
  constexpr std::uint64_t kSignature = 8;
  constexpr std::uint64_t kAround = 12;  // length, type and checksum
  std::array<unsigned char, 8> head{};   // length and type
  for (std::uint64_t at = kSignature; at + kAround <= r.size_bytes;) {
    if (std::fseek(r.file, static_cast<long>(at), SEEK_SET) != 0 ||
        std::fread(head.data(), 1, head.size(), r.file) != head.size())
      return "cannot be read";
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < 4; ++i) bytes = bytes << 8U | head[i];
    if (std::string_view(reinterpret_cast<const char*>(head.data()) + 4, 4) == "IEND")
      break;  // what follows is not read
    if (bytes > r.size_bytes - at - kAround)
      return "a chunk at byte " + std::to_string(at) + " has " + std::to_string(bytes) +
             " bytes, more than the file has left";
    at += kAround + bytes;
  }
  std::rewind(r.file);
  return {};
}

/// What is wrong with the size that the header promises, if anything.
std::string wrong_size(PngReading& r) {
  const std::uint64_t width = png_get_image_width(r.png, r.info);
  const std::uint64_t height = png_get_image_height(r.png, r.info);
  const std::string told = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width * height > static_cast<std::uint64_t>(kMaxPixels))
    return "the picture has " + told + "; " + std::to_string(kMaxPixels) + " are read at most";
  const std::uint64_t bits =
      std::uint64_t{png_get_bit_depth(r.png, r.info)} * png_get_channels(r.png, r.info);
  if (width * height / 8 * bits > kMaxPacking * r.size_bytes)
    return "the header promises " + told + ", more than the file's bytes can hold";
  r.image.width_px = static_cast<int>(width);
  r.image.height_px = static_cast<int>(height);
  return {};
}

}  // namespace

Result<GrayImage> read_png(const std::string& path) {
  const auto size = file_size_bytes(path);
  if (!size) return size.error();
  PngReading r;
  r.size_bytes = *size;
  r.file = std::fopen(path.c_str(), "rb");
  if (r.file == nullptr) return Error{path, "cannot be opened", ""};
  const std::string remedy = "is the file complete?";
  if (const std::string cut = cut_chunk(r); !cut.empty()) return Error{path, cut, remedy};
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, on_error, on_warning);
  r.info = r.png != nullptr ? png_create_info_struct(r.png) : nullptr;
  if (r.info == nullptr) return Error{path, "libpng does not start", ""};
  if (!read_header(r)) return Error{path, r.what, remedy};
  if (const std::string wrong = wrong_size(r); !wrong.empty()) return Error{path, wrong, remedy};
  if (!read_pixels(r)) return Error{path, r.what, remedy};
  return std::move(r.image);
}

}  // namespace beaconless::io
