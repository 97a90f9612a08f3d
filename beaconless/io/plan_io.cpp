// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/plan_io.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "beaconless/core/suggest.hpp"
#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {
namespace {

constexpr double kMaxCoordinate_m = 1e7;

std::optional<Eigen::Vector2d> point_of(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::list || node.size() != 2) return std::nullopt;
  const auto x = node.items[0].number();
  const auto y = node.items[1].number();
  if (!x || !y || std::abs(*x) > kMaxCoordinate_m || std::abs(*y) > kMaxCoordinate_m) return std::nullopt;
  return Eigen::Vector2d{*x, *y};
}

/// What stands where a point should, in words.
std::string described_point(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::list || node.size() != 2) return node.described();
  return "[" + node.items[0].described() + ", " + node.items[1].described() + "]";
}

}  // namespace

Result<FloorPlan> plan_from_yaml(const std::string& path, const YamlNode& yaml) {
  const std::string form = "walls: is a list of polylines, each a list of points [x, y] in metres";
  for (std::size_t i = 0; i < yaml.size(); ++i) {
    if (yaml.kind != YamlNode::Kind::map) break;
    if (yaml.key(i).text == "walls") continue;
    const std::array<std::string, 1> known{"walls"};
    const std::string near = nearest_word(yaml.key(i).text, known);
    return Error{where_in(path, yaml.key(i)), "a floor plan has no key " + yaml.key(i).described(),
                 near.empty() ? "allowed: walls" : "did you mean \"" + near + "\"?"};
  }
  const YamlNode* walls = yaml.find("walls");
  if (walls == nullptr) return Error{path, "holds " + yaml.described() + " without walls:", form};
  if (walls->kind != YamlNode::Kind::list || walls->size() == 0)
    return Error{where_in(path, *walls), "walls: is " + walls->described(), form};

  FloorPlan plan;
  for (const YamlNode& wall : walls->items) {
    const std::string where = where_in(path, wall);
    const std::string name = "walls: polyline " + std::to_string(plan.walls.size() + 1);
    if (wall.kind != YamlNode::Kind::list) return Error{where, name + " is " + wall.described(), form};
    if (wall.size() < 2)
      return Error{where, name + " is " + wall.described(), "a wall needs two points or more"};
    FloorPlan::Polyline corners;
    for (const YamlNode& node : wall.items) {
      const auto point = point_of(node);
      if (!point)
        return Error{where_in(path, node),
                     name + ", point " + std::to_string(corners.size() + 1) + " is " + described_point(node),
                     "a point is [x, y], two numbers within ±1e7 m"};
      corners.push_back(*point);
    }
    plan.walls.push_back(std::move(corners));
  }
  return plan;
}

Result<FloorPlan> read_plan(const std::string& path) {
  const auto yaml = read_yaml(path);
  if (!yaml) return yaml.error();
  return plan_from_yaml(path, *yaml);
}

Result<Done> write_plan(const std::string& path, const FloorPlan& plan) {
  std::string text = "# floor plan: walls as polylines, metres, map frame\nwalls:\n";
  for (const FloorPlan::Polyline& wall : plan.walls) {
    text += "  - [";
    for (std::size_t i = 0; i < wall.size(); ++i)
      text += (i == 0 ? "[" : ", [") + yaml_number(wall[i].x()) + ", " + yaml_number(wall[i].y()) + "]";
    text += "]\n";
  }
  return write_whole_file(path, text);
}

}  // namespace beaconless::io
