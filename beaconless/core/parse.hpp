// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace beaconless {

/// The text without a leading plus sign, which std::from_chars does not take; "+-1" stays as it is.
inline std::string_view without_plus(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

/// Reads a whole number-text as a double ("1.5", "-3e-4", "nan", "inf"); nothing when any character is left
/// over. Independent of the locale.
inline std::optional<double> parse_double(std::string_view text) {
  text = without_plus(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// Reads a whole number-text as an integer of type `Int`; nothing when it does not fit or is not all digits.
template <class Int = int>
std::optional<Int> parse_int(std::string_view text) {
  text = without_plus(text);
  Int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// The pieces of `text` between any of the characters in `separators`; empty pieces are left out.
inline std::vector<std::string_view> split_words(std::string_view text,
                                                 std::string_view separators = " \t\r\n") {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(separators); at != std::string_view::npos;) {
    const std::size_t end = text.find_first_of(separators, at);
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(separators, end);
  }
  return words;
}

}  // namespace beaconless
