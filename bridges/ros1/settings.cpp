// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros1/settings.hpp"

#include "beaconless/core/suggest.hpp"

#include "bridges/ros1/amcl_names.hpp"

namespace beaconless::ros1 {
namespace {

const Field* named(const std::vector<Field>& fields, std::string_view name) {
  for (const Field& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

std::string unknown(const std::string& name, const std::vector<Field>& fields) {
  std::vector<std::string> names;
  for (const AmclName& amcl : amcl_names())
    if (!amcl.ours.empty()) names.emplace_back(amcl.name);
  for (const Field& field : fields) names.push_back(field.name);
  const std::string near = nearest_word(name, names);
  return "~" + name + ": there is no such parameter, it is passed over" +
         (near.empty() ? "" : "; did you mean ~" + near + "?");
}

/// tf2's frames have no slash before them; those of older launch files do.
void strip_slash(std::string& frame) {
  if (frame.starts_with('/')) frame.erase(0, 1);
}

}  // namespace

Result<Settings> settings_of(const std::map<std::string, std::string>& parameters) {
  Settings settings;
  auto fields = fields_of(settings.node);
  for (Field& field : fields_of(settings.localizer)) fields.push_back(std::move(field));
  bool has_amcl_names = false;
  for (const auto& [name, value] : parameters) {
    const auto amcl = amcl_name(name);
    if (amcl && amcl->ours.empty()) {
      settings.remarks.push_back("~" + name + " changes nothing here: " + std::string(amcl->remark));
      continue;
    }
    const Field* field = named(fields, amcl ? amcl->ours : name);
    if (field == nullptr) {
      settings.remarks.push_back(unknown(name, fields));
      continue;
    }
    has_amcl_names = has_amcl_names || amcl;
    if (auto set = field->set(value); !set) return Error{"~" + name, set.error().what, set.error().remedy};
    if (name.starts_with("initial_pose_")) settings.has_initial_pose = true;
    if (name.starts_with("base_from_laser.")) settings.has_base_from_laser = true;
  }
  if (has_amcl_names && !settings.localizer.method.starts_with("amcl"))
    settings.remarks.push_back("parameters of particles are given, and the method is '" +
                               settings.localizer.method +
                               "', which has none: ~method:=amcl or amcl+walls would hear of them");
  if (settings.has_base_from_laser && scan_topics_of(settings.node).size() > 1)
    return Error{"~base_from_laser", "there are several lasers in ~scan_topics",
                 "let tf tell where each sits"};
  for (std::string* frame :
       {&settings.node.global_frame_id, &settings.node.odom_frame_id, &settings.node.base_frame_id})
    strip_slash(*frame);
  return settings;
}

}  // namespace beaconless::ros1
