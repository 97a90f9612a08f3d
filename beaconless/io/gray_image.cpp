// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/gray_image.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {

Result<GrayImage> read_image(const std::string& path) {
  if (const auto size = file_size_bytes(path); !size) return size.error();
  std::array<char, 8> bytes{};
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), bytes.size());
  const std::string_view magic(bytes.data(), static_cast<std::size_t>(in.gcount()));

  if (magic.starts_with("P2") || magic.starts_with("P5")) return read_pgm(path);
  if (magic == "\x89PNG\r\n\x1a\n") return read_png(path);
  const std::string remedy = "save the picture as PGM or PNG";
  if (magic.empty()) return Error{path, "the file is empty", remedy};
  if (magic.starts_with("BM")) return Error{path, "is a BMP picture, which is not read", remedy};
  if (magic.starts_with("\xFF\xD8"))
    return Error{path, "is a JPEG picture, which blurs cells and is not read", remedy};
  for (const char* pnm : {"P1", "P3", "P4", "P6", "P7"})
    if (magic.starts_with(pnm)) return Error{path, std::string("is a PNM picture of kind ") + pnm, remedy};
  return Error{path, "is no picture that is known here", remedy};
}

}  // namespace beaconless::io
