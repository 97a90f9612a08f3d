// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "beaconless/core/parse.hpp"

namespace beaconless::io {

/// Reads a whole number-text as the nearest float, without a detour through double; "nan" and "inf" too.
/// What no float can hold becomes 0 or infinity. Nothing when any character is left over.
inline std::optional<float> parse_float(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  float value = 0.0F;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc{}) return value;
  const auto wide = parse_double(text);
  return wide ? std::optional(static_cast<float>(*wide)) : std::nullopt;
}

/// Appends the shortest text that reads back as the very same number.
template <std::floating_point Number>
void append_number(std::string& text, Number value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end);
}

/// Takes the next word from the front of `rest`; empty at the end.
inline std::string_view take_word(std::string_view& rest) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t start = rest.find_first_not_of(kBlank);
  if (start == std::string_view::npos) return rest = {};
  const std::size_t end = rest.find_first_of(kBlank, start);
  const std::string_view word = rest.substr(start, end - start);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end);
  return word;
}

}  // namespace beaconless::io
