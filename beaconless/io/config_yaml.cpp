// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/config_yaml.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "beaconless/io/whole_file.hpp"
#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::io {
namespace {

/// One `key: value` of the file, its key written out with dots.
struct Setting {
  std::string name;
  const YamlNode* value;
};

bool is_section(const std::vector<Field>& fields, const std::string& name) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const Field& f) { return f.name.starts_with(name + "."); });
}

/// Walks down the maps; a section left empty (all its lines commented out, say) sets nothing.
void collect(const std::vector<Field>& fields, const YamlNode& map, const std::string& prefix,
             std::vector<Setting>& settings) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    const std::string name = prefix + map.key(i).text;
    const YamlNode& value = map.value(i);
    const bool section = is_section(fields, name);
    if (section && value.kind == YamlNode::Kind::map) collect(fields, value, name + ".", settings);
    if (!section || (value.kind != YamlNode::Kind::map && value.kind != YamlNode::Kind::null))
      settings.push_back({name, &value});
  }
}

Result<Done> apply(const std::string& path, const Setting& setting, const std::vector<Field>& fields) {
  const std::string where = where_in(path, *setting.value);
  const auto field =
      std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == setting.name; });
  if (field == fields.end()) {
    if (is_section(fields, setting.name))
      return Error{where, setting.name + " is " + setting.value->described(),
                   "it is a section: a map of parameters"};
    const Error error = set_field(fields, setting.name, "").error();
    return Error{where, setting.name + ": " + error.what, error.remedy};
  }
  if (setting.value->kind != YamlNode::Kind::scalar)
    return Error{where, setting.name + " is " + setting.value->described(), "allowed: " + field->allowed()};
  const auto set = field->set(setting.value->text);
  if (!set) return Error{where, setting.name + ": " + set.error().what, set.error().remedy};
  return Done{};
}

Result<Done> apply_all(const std::string& path, const std::vector<Setting>& settings,
                       const std::vector<Field>& fields) {
  std::set<std::string_view> seen;
  for (const Setting& setting : settings) {
    if (!seen.insert(setting.name).second)
      return Error{where_in(path, *setting.value), setting.name + " is set twice", "keep one of the two"};
    if (auto set = apply(path, setting, fields); !set) return set;
  }
  return Done{};
}

std::string line_of(const Field& field, const Field* standard, std::string_view key,
                    const std::string& indent) {
  const std::string text = field.text();
  std::string line = indent + std::string(key) + ": " + yaml_text(text) + "  # ";
  if (standard != nullptr && standard->text() != text)
    line += "changed, default " + yaml_text(standard->text()) + "; ";
  return line + field.allowed() + "; " + field.sentence + "\n";
}

/// The fields whose names begin with `prefix`, in order; sections where their first field stands.
void emit(const std::vector<Field>& fields, const std::vector<Field>& defaults, const std::string& prefix,
          const std::string& indent, std::string& text) {
  std::set<std::string> begun;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view name = fields[i].name;
    if (!name.starts_with(prefix)) continue;
    const std::string_view rest = name.substr(prefix.size());
    const std::size_t dot = rest.find('.');
    if (dot == std::string_view::npos) {
      text += line_of(fields[i], i < defaults.size() ? &defaults[i] : nullptr, rest, indent);
    } else if (const std::string section(rest.substr(0, dot)); begun.insert(section).second) {
      text += indent + section + ":\n";
      emit(fields, defaults, prefix + section + ".", indent + "  ", text);
    }
  }
}

}  // namespace

Result<Done> read_config(const std::string& path, const std::vector<Field>& fields) {
  const auto yaml = read_yaml(path);
  if (!yaml) return yaml.error();
  if (yaml->kind == YamlNode::Kind::null) return Done{};
  if (yaml->kind != YamlNode::Kind::map)
    return Error{where_in(path, *yaml), "holds " + yaml->described(),
                 "a config is lines of `parameter: value`"};
  std::vector<Setting> settings;
  collect(fields, *yaml, "", settings);

  std::vector<std::string> before;
  before.reserve(fields.size());
  for (const Field& field : fields) before.push_back(field.text());
  auto applied = apply_all(path, settings, fields);
  if (!applied)
    for (std::size_t i = 0; i < fields.size(); ++i) (void)fields[i].set(before[i]);
  return applied;
}

std::string config_yaml(const std::vector<Field>& fields, const std::vector<Field>& defaults) {
  std::string text;
  emit(fields, defaults, "", "", text);
  return text;
}

Result<Done> write_config(const std::string& path, const std::vector<Field>& fields,
                          const std::vector<Field>& defaults) {
  return write_whole_file(path, config_yaml(fields, defaults));
}

}  // namespace beaconless::io
