// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// One value of a YAML file, and the line it stands on.
struct YamlNode {
  enum class Kind : std::uint8_t { null, scalar, list, map };

  Kind kind = Kind::null;
  int line = 0;                 ///< counted from 1
  std::string text;             ///< of a scalar
  std::vector<YamlNode> items;  ///< of a list; of a map: key, value, key, value …

  std::size_t size() const { return kind == Kind::map ? items.size() / 2 : items.size(); }
  const YamlNode& key(std::size_t i) const { return items[2 * i]; }
  const YamlNode& value(std::size_t i) const { return items[2 * i + 1]; }

  /// The value of a map's key; null when there is no such key.
  const YamlNode* find(std::string_view name) const;

  /// The scalar as a finite number.
  std::optional<double> number() const;

  /// The value in words, for messages: `"0.05"`, "a list of 3", "a map", "nothing".
  std::string described() const;
};

inline constexpr std::uint64_t kMaxYamlBytes = 16U << 20U;

/// Reads a file of one YAML document; the line endings and the byte order mark do not matter.
///
/// Errors (with path and line): not YAML, longer than kMaxYamlBytes, deeper than 32 levels, a second
/// document, a key that comes twice, a key that is not a word, an alias (`*name`, which a small file can use
/// to mean a huge one). An empty file is a null node.
Result<YamlNode> read_yaml(const std::string& path);

/// The same of what was read from the file already; its path is for messages.
Result<YamlNode> parse_yaml(const std::string& path, std::string bytes);

/// "path:line", the form of Error::where.
std::string where_in(const std::string& path, const YamlNode& node);

/// A text as it can stand behind `key: `; quoted only where YAML would take it for something else.
std::string yaml_text(std::string_view text);

/// The shortest decimal that reads back as the same double.
std::string yaml_number(double value);

}  // namespace beaconless::io
