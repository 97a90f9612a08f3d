// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/topic_choice.hpp"

#include <string_view>
#include <vector>

#include "beaconless/core/suggest.hpp"
#include "beaconless/io/ros_events.hpp"

namespace beaconless::io {
namespace {

std::string_view without_slash(std::string_view name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

std::string listed(std::span<const Topic> topics) {
  constexpr std::size_t kShown = 20;
  std::string text;
  for (const Topic& topic : topics.first(std::min(topics.size(), kShown)))
    text += (text.empty() ? "" : ", ") + topic.name + " (" + std::to_string(topic.count) + " scans)";
  return topics.size() > kShown ? text + ", …" : text;
}

}  // namespace

bool is_scan_topic(const Topic& topic) { return topic.type == "scan" || is_laser_scan_type(topic.type); }

Result<std::string> choose_scan_topic(const std::string& path, const RecordingOptions& options,
                                      std::span<const Topic> scan_topics) {
  const std::string& wanted = options.topic;
  if (wanted.empty()) {
    if (scan_topics.empty()) return std::string();
    if (scan_topics.size() == 1) return scan_topics.front().name;
    if (options.scans_optional) return std::string();
    return Error{path, "several scan topics and none chosen: " + listed(scan_topics),
                 "choose one with --topic"};
  }
  std::vector<std::string> names;
  for (const Topic& topic : scan_topics) {
    if (without_slash(topic.name) == without_slash(wanted)) return topic.name;
    names.push_back(topic.name);
  }
  if (names.empty()) return Error{path, "no scan topic '" + wanted + "': there are no scans at all", ""};
  const std::string near = nearest_word(wanted, names);
  return Error{path, "no scan topic '" + wanted + "'; there are " + listed(scan_topics),
               near.empty() ? "" : "did you mean " + near + "?"};
}

}  // namespace beaconless::io
