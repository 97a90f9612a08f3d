// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <limits>
#include <optional>

#include "beaconless/io/gray_image.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

constexpr int kEnd = std::char_traits<char>::eof();
constexpr std::uint32_t kMaxMaxval = 65535;

bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_digit(int c) { return c >= '0' && c <= '9'; }

/// Reads the numbers of a PGM one by one; knows the byte it stands at.
class PgmBytes {
 public:
  explicit PgmBytes(const std::string& path) : in_(path, std::ios::binary) {}

  int get() {
    const int c = in_.rdbuf()->sbumpc();
    if (c != kEnd) ++at_;
    return c;
  }
  std::uint64_t at() const { return at_; }

  /// The next decimal number, past blanks and `#` comments; nothing when there is none or it is over 32 bits.
  /// The one blank, or comment with its line end, that ends it is taken too.
  std::optional<std::uint32_t> number() {
    int c = get();
    while (is_space(c) || c == '#') {
      if (c == '#') skip_comment();
      c = get();
    }
    if (!is_digit(c)) return std::nullopt;
    std::uint64_t value = 0;
    for (; is_digit(c); c = get()) {
      value = 10 * value + static_cast<std::uint64_t>(c - '0');
      if (value > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
    }
    if (c == '#')
      skip_comment();
    else if (c != kEnd && !is_space(c))
      return std::nullopt;
    return static_cast<std::uint32_t>(value);
  }

  bool read(std::vector<std::uint8_t>& bytes) {
    const auto wanted = static_cast<std::streamsize>(bytes.size());
    const auto met = in_.rdbuf()->sgetn(reinterpret_cast<char*>(bytes.data()), wanted);
    at_ += static_cast<std::uint64_t>(met);
    return met == wanted;
  }

 private:
  void skip_comment() {
    for (int c = get(); c != '\n' && c != '\r' && c != kEnd;) c = get();
  }

  std::ifstream in_;
  std::uint64_t at_ = 0;
};

std::uint8_t scaled(std::uint32_t shade, std::uint32_t maxval) {
  return static_cast<std::uint8_t>((std::min(shade, maxval) * 255U + maxval / 2) / maxval);
}

bool read_binary(PgmBytes& bytes, std::uint32_t maxval, GrayImage& image) {
  const bool wide = maxval > 255;
  const auto width = static_cast<std::size_t>(image.width_px);
  std::vector<std::uint8_t> row(wide ? 2 * width : width);
  for (auto shade = image.shades.begin(); shade != image.shades.end();) {
    if (!bytes.read(row)) return false;
    for (std::size_t x = 0; x < width; ++x, ++shade)
      *shade = scaled(wide ? row[2 * x] * 256U + row[2 * x + 1] : row[x], maxval);
  }
  return true;
}

bool read_text(PgmBytes& bytes, std::uint32_t maxval, GrayImage& image) {
  for (std::uint8_t& shade : image.shades) {
    const auto number = bytes.number();
    if (!number) return false;
    shade = scaled(*number, maxval);
  }
  return true;
}

}  // namespace

Result<GrayImage> read_pgm(const std::string& path) {
  const auto size = file_size_bytes(path);
  if (!size) return size.error();
  PgmBytes bytes(path);
  const auto at = [&] { return path + "@" + std::to_string(bytes.at()); };
  if (bytes.get() != 'P') return Error{path, "is not PGM: it does not begin with P2 or P5", ""};
  const int kind = bytes.get();
  if (kind != '2' && kind != '5') return Error{path, "is not PGM: it does not begin with P2 or P5", ""};

  const auto width = bytes.number();
  const auto height = width ? bytes.number() : std::nullopt;
  const auto maxval = height ? bytes.number() : std::nullopt;
  if (!maxval) return Error{at(), "the PGM header is not width, height, maxval", "is the file complete?"};
  const std::string told = std::to_string(*width) + " x " + std::to_string(*height) + " pixels";
  if (*width == 0 || *height == 0) return Error{at(), "the picture has " + told, ""};
  if (*maxval == 0 || *maxval > kMaxMaxval)
    return Error{at(), "maxval is " + std::to_string(*maxval), "allowed: 1 … 65535"};

  const std::uint64_t pixels = std::uint64_t{*width} * *height;
  if (pixels > static_cast<std::uint64_t>(kMaxPixels))
    return Error{at(), "the picture has " + told, "allowed: " + std::to_string(kMaxPixels) + " in all"};
  const std::uint64_t needed = kind == '2' ? 2 * pixels - 1 : pixels * (*maxval > 255 ? 2 : 1);
  if (*size - bytes.at() < needed)
    return Error{at(), "the header promises " + told + ", the file ends too early for them",
                 "is it complete?"};

  GrayImage image{static_cast<int>(*width), static_cast<int>(*height), std::vector<std::uint8_t>(pixels), {}};
  const bool read = kind == '5' ? read_binary(bytes, *maxval, image) : read_text(bytes, *maxval, image);
  if (!read) return Error{at(), "here should be one of " + told, "is the file complete?"};
  return image;
}

Result<Done> write_pgm(const std::string& path, const GrayImage& image) {
  std::string bytes =
      "P5\n" + std::to_string(image.width_px) + " " + std::to_string(image.height_px) + "\n255\n";
  bytes.append(image.shades.begin(), image.shades.end());
  return write_whole_file(path, bytes);
}

}  // namespace beaconless::io
