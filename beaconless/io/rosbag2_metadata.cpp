// SPDX-License-Identifier: Apache-2.0
#include "beaconless/io/rosbag2_metadata.hpp"

#include <cstdint>
#include <string_view>

#include <fmt/format.h>

namespace beaconless::io {
namespace {

/// As YAML's double quotes want it.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace

std::string rosbag2_metadata(const Rosbag2Writer& bag, const std::string& file_name) {
  std::uint64_t messages = 0;
  std::string topics;
  for (const Rosbag2Topic& topic : bag.topics()) {
    messages += topic.messages;
    topics += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n        serialization_format: cdr\n"
        "        offered_qos_profiles: {}\n      message_count: {}\n",
        quoted(topic.name), topic.type, quoted(rosbag2_qos(topic.is_latched)), topic.messages);
  }
  const auto times = [&](const char* indent) {
    return fmt::format(
        "{0}duration:\n{0}  nanoseconds: {1}\n{0}starting_time:\n{0}  nanoseconds_since_epoch: {2}\n", indent,
        bag.end_ns() - bag.start_ns(), bag.start_ns());
  };
  return fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n{0}  message_count: {1}\n"
      "  topics_with_message_count:{2}\n{3}  compression_format: \"\"\n  compression_mode: \"\"\n"
      "  relative_file_paths:\n    - {4}\n  files:\n    - path: {4}\n{5}      message_count: {1}\n",
      times("  "), messages, topics.empty() ? " []" : "", topics, quoted(file_name), times("      "));
}

}  // namespace beaconless::io
