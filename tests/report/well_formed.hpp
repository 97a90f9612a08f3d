// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace beaconless::report {

/// What keeps `text` from being well-formed XML, as far as the balance of tags and quotes tells; "" when
/// nothing does.
inline std::string xml_fault(std::string_view text) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '<') continue;
    if (text.substr(at, 2) == "<!") {
      at = text.find('>', at);
      continue;
    }
    char quote = 0;
    std::size_t end = at + 1;
    for (; end < text.size() && (quote != 0 || text[end] != '>'); ++end) {
      if (text[end] == '<') return "a < inside the tag at byte " + std::to_string(at);
      if (quote != 0 && text[end] == quote)
        quote = 0;
      else if (quote == 0 && (text[end] == '"' || text[end] == '\''))
        quote = text[end];
    }
    if (end == text.size()) return "the tag at byte " + std::to_string(at) + " does not end";
    const std::string_view tag = text.substr(at + 1, end - at - 1);
    const std::string name(
        tag.substr(tag.front() == '/' ? 1 : 0, tag.find_first_of(" />", 1) - (tag.front() == '/')));
    if (tag.front() == '/') {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : open.back() + " stays open";
}

}  // namespace beaconless::report
