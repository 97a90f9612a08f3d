// SPDX-License-Identifier: Apache-2.0
#include "region_on_map.hpp"

#include <fmt/format.h>

#include "beaconless/map/wall_box.hpp"

namespace beaconless::cli {

Result<Done> check_on_map(std::string_view words, const SearchRegion& region, const Map& map) {
  const Eigen::AlignedBox2d box = wall_box(map);
  // A map without walls is refused elsewhere.
  if (box.isEmpty() || box.exteriorDistance(region.middle) <= region.radius_m) return Done{};
  return Error{"--start",
               fmt::format("\"{}\" lies wholly off the map, whose walls are between {:.1f},{:.1f} and "
                           "{:.1f},{:.1f}",
                           words, box.min().x(), box.min().y(), box.max().x(), box.max().y()),
               "write near:x,y,radius in metres of the map's frame, or auto"};
}

}  // namespace beaconless::cli
