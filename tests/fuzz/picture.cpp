// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "beaconless/io/grid_io.hpp"

#include "tests/fuzz/checks.hpp"

namespace beaconless::fuzz {
namespace {

/// Sets the checksums of a PNG right, so that what is changed at random gets past them.
void mend_checksums(std::vector<unsigned char>& png) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAround = 12;  // length, name, checksum
  for (std::size_t at = kSignature; at + kAround <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | png[at + i];
    if (length > png.size() - at - kAround) return;
    const auto crc = crc32(0, png.data() + at + 4, static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i)
      png[at + 8 + length + i] = static_cast<unsigned char>(crc >> (24 - 8 * i));
    at += kAround + length;
  }
}

}  // namespace

void read_picture(Bytes bytes) {
  if (bytes.empty()) return;
  static const InputFolder folder;
  const unsigned how = bytes[0];
  std::vector<unsigned char> picture(bytes.begin() + 1, bytes.end());
  if (how % 2 == 1) mend_checksums(picture);
  folder.write("map.picture", picture);
  constexpr std::array kModes{"trinary", "scale", "raw", "trinary"};
  const std::string yaml =
      std::string(
          "image: map.picture\nresolution: 0.05\norigin: [1, 2, 0.3]\noccupied_thresh: 0.65\n"
          "free_thresh: 0.196\nnegate: ") +
      (how / 8 % 2 == 1 ? "1" : "0") + "\nmode: " + kModes[how / 2 % 4] + "\n";
  const auto grid = io::read_grid(
      folder.write("map.yaml", {reinterpret_cast<const unsigned char*>(yaml.data()), yaml.size()}));
  if (!grid) return check(grid.error());
  require(grid->width_cells > 0 && grid->height_cells > 0 &&
              grid->occupancy_percent.size() ==
                  static_cast<std::size_t>(grid->width_cells) * static_cast<std::size_t>(grid->height_cells),
          "a grid has a value a cell");
  for (const std::int8_t value : grid->occupancy_percent)
    require(value >= OccupancyGrid::kUnknown && value <= OccupancyGrid::kOccupied,
            "occupancy is -1 or 0 … 100");
}

}  // namespace beaconless::fuzz
