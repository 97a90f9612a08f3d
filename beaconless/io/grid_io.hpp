// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/gray_image.hpp"
#include "beaconless/io/yaml_tree.hpp"
#include "beaconless/map/occupancy_grid.hpp"

namespace beaconless::io {

/// How a picture's shades become occupancy: map_server's three modes.
enum class GridMode : std::uint8_t { trinary, scale, raw };

/// How to read a picture as a grid; the keys of a map_server YAML.
struct GridShades {
  GridMode mode = GridMode::trinary;
  bool negate = false;  ///< false: black is occupied
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
};

/// The occupancy of each of the 256 shades, for opaque pixels.
///
/// With p = (255 - shade) / 255 (negated: shade / 255), trinary: p > occupied_thresh is 100, p < free_thresh
/// is 0, the rest is unknown. Scale: the rest is 99 (p - free_thresh) / (occupied_thresh - free_thresh),
/// rounded. Raw: the shade itself (negated: 255 - shade), and unknown beyond 100. Source:
/// wiki.ros.org/map_server. Differs: its program has 1 + 98 r for 99 r in scale mode.
std::int8_t occupancy_percent_of(std::uint8_t shade, const GridShades& shades);

/// Makes a grid of a map_server YAML and the picture it names, which is found relative to the YAML.
///
/// `resolution` and `origin: [x, y, yaw]` must be there and the yaw is honoured; `negate`, `occupied_thresh`,
/// `free_thresh` and `mode` have defaults (see GridShades); other keys are passed over, as map_server does.
/// The grid's own thresholds are those of the YAML in percent; in scale mode 100 and 0, since there the
/// shades beyond the YAML's thresholds have become 100 and 0. Differs: map_server averages opacity in with
/// the colours in trinary mode; here only colours count. In scale mode any transparency is unknown, as its
/// page says. Errors (with path:line): a missing or wrong value, thresholds out of order, and those of
/// `read_image`.
Result<OccupancyGrid> grid_from_yaml(const std::string& path, const YamlNode& yaml);

/// Reads a map_server grid; `read_map` takes either kind of map.
Result<OccupancyGrid> read_grid(const std::string& path);

/// Writes a grid as `path` (.yaml or .yml) and a PGM of the same name beside it, trinary, as map_saver does.
///
/// Occupied is black, free 254, unknown 205 (or mid-way between the thresholds, where 205 would be read as
/// something else). Cells that are known but neither occupied nor free become unknown, as they do in
/// map_saver.
Result<Done> write_grid(const std::string& path, const OccupancyGrid& grid);

}  // namespace beaconless::io
