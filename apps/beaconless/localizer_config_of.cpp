// SPDX-License-Identifier: Apache-2.0
#include "localizer_config_of.hpp"

#include <fmt/format.h>

#include "beaconless/io/config_yaml.hpp"
#include "beaconless/io/yaml_tree.hpp"

namespace beaconless::cli {
namespace {

/// The options that stand for parameters, as those.
std::vector<std::string> shorthands(const LocalizeWords& words) {
  std::vector<std::string> set;
  if (!words.line_fit.empty())
    set.push_back("features.corners.lines.fit.method=" +
                  std::string(words.line_fit == "lsf" ? "regression" : words.line_fit));
  if (!words.loss.empty())
    for (const char* name : {"icp.loss", "feature_icp.loss"}) set.push_back(name + ("=" + words.loss));
  if (words.sigma_m > 0.0)
    for (const char* name :
         {"walls.sigma_m", "icp.sigma_m", "hector.sigma_m", "features.corners.lines.sigma_m",
          "features.falko.sigma_m", "features.rdp.segmentation.sigma_m"})
      set.push_back(fmt::format("{}={}", name, words.sigma_m));
  return set;
}

/// Refuses options that the method would not hear of.
Result<Done> check_effect(const LocalizeWords& words, const std::string& method) {
  const bool is_icp = method.starts_with("icp-");
  const bool is_of_corners = method.starts_with("icp-corners");
  const bool is_of_whole_scans = method == "walls" || method.ends_with("-full");
  const auto refused = [&](const char* option, const char* for_whom) {
    return Error{option, "it changes nothing about " + method,
                 std::string("leave it out; it is for ") + for_whom};
  };
  if (!words.line_fit.empty() && !is_of_corners)
    return refused("--line-fit", "icp-corners and icp-corners-ft");
  if (!words.loss.empty() && !is_icp) return refused("--loss", "the methods that begin with icp");
  if (!words.preset.empty() && is_of_whole_scans) return refused("--preset", "methods of features");
  return Done{};
}

}  // namespace

Result<Done> check_config_file(const std::string& path) {
  if (path.empty()) return Done{};
  const auto yaml = io::read_yaml(path);
  if (!yaml) return yaml.error();
  if (yaml->kind == io::YamlNode::Kind::map || yaml->kind == io::YamlNode::Kind::null) return Done{};
  return Error{io::where_in(path, *yaml), "holds " + yaml->described(),
               "a config is lines of `parameter: value`"};
}

Result<LocalizerConfig> localizer_config_of(const LocalizeWords& words) {
  LocalizerConfig config;
  const auto fields = fields_of(config);
  if (!words.config.empty())
    if (auto read = io::read_config(words.config, fields); !read) return read.error();
  if (!words.method.empty()) config.method = words.method;
  if (auto heard = check_effect(words, config.method); !heard) return heard.error();
  if (!words.preset.empty()) {
    const auto preset = detectors_preset(words.preset);
    if (!preset) return preset.error();
    config.features.detectors = *preset;
  }
  if (auto set = set_parameters(fields, shorthands(words)); !set) return set.error();
  if (!words.base_from_laser.empty()) {
    const auto pose = pose_from_words("--base-from-laser", words.base_from_laser);
    if (!pose) return pose.error();
    config.base_from_laser = *pose;
  }
  if (auto set = set_parameters(fields, words.set); !set) return set.error();
  return config;
}

}  // namespace beaconless::cli
