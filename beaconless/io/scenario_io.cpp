// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/scenario_io.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "beaconless/core/suggest.hpp"
#include "beaconless/io/plan_io.hpp"
#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::io {
namespace {

using Words = std::vector<std::string>;
using Points = std::vector<Eigen::Vector2d>;

std::string joined(const Words& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

template <std::size_t Count>
std::optional<std::array<double, Count>> numbers_of(const YamlNode& list) {
  std::array<double, Count> numbers{};
  if (list.kind != YamlNode::Kind::list || list.size() != Count) return std::nullopt;
  for (std::size_t i = 0; i < Count; ++i) {
    const auto number = list.items[i].number();
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

/// Fills a scenario from its file, key by key.
class ScenarioReader {
 public:
  explicit ScenarioReader(const std::string& path) : path_(path) {}

  Result<sim::Scenario> read() {
    const auto yaml = read_yaml(path_);
    if (!yaml) return yaml.error();
    scenario_.name = std::filesystem::path(path_).stem().string();
    const Words parts{"description", "plan", "base_from_laser", "lidar", "path", "people"};
    if (auto set = set_fields(*yaml, "a scenario", fields_of(scenario_), parts); !set) return set.error();
    for (const char* needed : {"plan", "path"})
      if (yaml->find(needed) == nullptr)
        return Error{path_, std::string("has no ") + needed + ":", "it is needed"};

    if (const auto* node = yaml->find("description")) scenario_.description = node->text;
    for (const auto& [key, read_part] : {std::pair{"plan", &ScenarioReader::read_plan_of},
                                         {"base_from_laser", &ScenarioReader::read_laser_pose},
                                         {"lidar", &ScenarioReader::read_lidar},
                                         {"path", &ScenarioReader::read_drive},
                                         {"people", &ScenarioReader::read_people}})
      if (const auto* node = yaml->find(key))
        if (auto done = (this->*read_part)(*node); !done) return done.error();
    if (const auto good = sim::check(scenario_); !good)
      return Error{path_, good.error().where + ": " + good.error().what, good.error().remedy};
    return std::move(scenario_);
  }

 private:
  Result<Done> read_plan_of(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::scalar)
      return error(node, "plan is " + node.described(), "name a floor plan file");
    auto plan = read_plan((std::filesystem::path(path_).parent_path() / node.text).string());
    if (!plan) return plan.error();
    scenario_.plan = std::move(plan).value();
    return Done{};
  }

  Result<Done> read_laser_pose(const YamlNode& node) {
    const auto pose = numbers_of<3>(node);
    if (!pose) return error(node, "base_from_laser is " + node.described(), "it is [x_m, y_m, theta_deg]");
    scenario_.base_from_laser = {(*pose)[0], (*pose)[1], radians((*pose)[2])};
    return Done{};
  }

  Result<Done> read_lidar(const YamlNode& node) {
    return set_fields(node, "lidar", fields_of(scenario_.lidar), {});
  }

  Result<Done> read_drive(const YamlNode& node) {
    const Words kinds{"standing", "turning", "ellipse", "waypoints"};
    const std::array<sim::Path, 4> paths{sim::Standing{}, sim::Turning{}, sim::Ellipse{}, sim::Waypoints{}};
    if (node.kind != YamlNode::Kind::map) return error(node, "path is " + node.described(), "it is a map");
    const YamlNode* kind = node.find("kind");
    if (kind == nullptr) return error(node, "path has no kind:", "kind: " + joined(kinds, " | "));
    const auto known = std::find(kinds.begin(), kinds.end(), kind->text);
    if (known == kinds.end())
      return error(*kind, "kind is " + kind->described(), "allowed: " + joined(kinds, " | "));
    scenario_.path = paths[static_cast<std::size_t>(known - kinds.begin())];

    auto* way = std::get_if<sim::Waypoints>(&scenario_.path);
    const auto fields = std::visit([](auto& path) { return fields_of(path); }, scenario_.path);
    const Words others = way != nullptr ? Words{"kind", "points"} : Words{"kind"};
    if (auto set = set_fields(node, *known + " path", fields, others); !set) return set;
    if (const auto* points = node.find("points"); way != nullptr && points != nullptr)
      return read_points(*points, "points", way->points);
    return Done{};
  }

  Result<Done> read_people(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::list)
      return error(node, "people is " + node.described(), "it is a list");
    for (const YamlNode& item : node.items) {
      sim::Person person;
      if (auto set = set_fields(item, "a person", fields_of(person), {"waypoints"}); !set) return set;
      if (const auto* points = item.find("waypoints"))
        if (auto read = read_points(*points, "waypoints", person.waypoints); !read) return read;
      scenario_.people.push_back(std::move(person));
    }
    return Done{};
  }

  Result<Done> read_points(const YamlNode& node, const std::string& name, Points& points) const {
    const std::string form = name + " is a list of [x, y] in metres";
    if (node.kind != YamlNode::Kind::list) return error(node, name + " is " + node.described(), form);
    for (const YamlNode& item : node.items) {
      const auto point = numbers_of<2>(item);
      if (!point) return error(item, "a point of " + name + " is " + item.described(), form);
      points.emplace_back((*point)[0], (*point)[1]);
    }
    return Done{};
  }

  /// Sets the fields that a map names; `others` are its keys that are read elsewhere.
  Result<Done> set_fields(const YamlNode& map, const std::string& name, const std::vector<Field>& fields,
                          const Words& others) const {
    if (map.kind != YamlNode::Kind::map) return error(map, name + " is " + map.described(), "it is a map");
    for (std::size_t i = 0; i < map.size(); ++i) {
      const std::string& key = map.key(i).text;
      const YamlNode& value = map.value(i);
      if (std::find(others.begin(), others.end(), key) != others.end()) continue;
      const auto field =
          std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == key; });
      if (field == fields.end()) return unknown_key(map.key(i), name, fields, others);
      if (value.kind != YamlNode::Kind::scalar)
        return error(value, key + " is " + value.described(), "allowed: " + field->allowed());
      if (const auto set = field->set(value.text); !set)
        return error(value, key + ": " + set.error().what, set.error().remedy);
    }
    return Done{};
  }

  Error unknown_key(const YamlNode& key, const std::string& name, const std::vector<Field>& fields,
                    Words known) const {
    for (const Field& field : fields) known.push_back(field.name);
    const std::string near = nearest_word(key.text, known);
    return error(key, name + " has no key " + key.described(),
                 near.empty() ? "known: " + joined(known, ", ") : "did you mean \"" + near + "\"?");
  }

  Error error(const YamlNode& node, std::string what, std::string remedy) const {
    return {where_in(path_, node), std::move(what), std::move(remedy)};
  }

  std::string path_;
  sim::Scenario scenario_;
};

}  // namespace

Result<sim::Scenario> read_scenario(const std::string& path) { return ScenarioReader(path).read(); }

std::vector<std::string> scenario_names(const std::string& directory) {
  std::vector<std::string> names;
  std::error_code failed;
  for (std::filesystem::directory_iterator file(directory, failed), end; !failed && file != end;
       file.increment(failed))
    if (file->path().extension() == ".yaml") names.push_back(file->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace beaconless::io
