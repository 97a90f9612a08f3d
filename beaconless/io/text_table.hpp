// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/io/whole_file.hpp"

namespace beaconless::io {

/// Reads a text of one row a line, a trajectory say, whole; up to 1 GiB.
inline Result<std::string> read_text_table(const std::string& path) {
  return read_whole_file(path, 1ULL << 30U);
}

/// Calls `visit(line number, row)` for each line that is neither blank nor a `#` comment. Lines count from 1
/// and may end as on any system.
template <class Visit>
void for_each_row(std::string_view text, Visit&& visit) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    std::string_view row = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    while (!row.empty() && (row.back() == '\r' || row.back() == ' ' || row.back() == '\t'))
      row.remove_suffix(1);
    while (!row.empty() && (row.front() == ' ' || row.front() == '\t')) row.remove_prefix(1);
    if (!row.empty() && row.front() != '#') visit(line, row);
  }
}

/// A text met in a file, short enough for a message.
inline std::string shown(std::string_view text) {
  constexpr std::size_t kShown = 40;
  return text.size() <= kShown ? std::string(text) : std::string(text.substr(0, kShown)) + "…";
}

}  // namespace beaconless::io
