// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/map_io.hpp"

#include "beaconless/io/grid_io.hpp"
#include "beaconless/io/plan_io.hpp"
#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::io {

Result<Map> read_map(const std::string& path) {
  const std::string remedy = "give the YAML of a floor plan (walls:) or of a map_server grid (image:)";
  if (path.ends_with(".pgm") || path.ends_with(".png"))
    return Error{path, "is only the picture of a map", "give its YAML, which tells resolution and origin"};
  const auto yaml = read_yaml(path);
  if (!yaml) return yaml.error();
  const YamlNode* walls = yaml->find("walls");
  const YamlNode* image = yaml->find("image");
  if (walls != nullptr && image != nullptr)
    return Error{where_in(path, *image), "the file has both walls: and image:", remedy};
  if (walls != nullptr) {
    auto plan = plan_from_yaml(path, *yaml);
    if (!plan) return plan.error();
    return Map(std::move(plan).value());
  }
  if (image != nullptr) {
    auto grid = grid_from_yaml(path, *yaml);
    if (!grid) return grid.error();
    return Map(std::move(grid).value());
  }
  return Error{path, "holds " + yaml->described() + " with neither walls: nor image:", remedy};
}

}  // namespace beaconless::io
