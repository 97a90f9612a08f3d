// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/describe.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "beaconless/core/parse.hpp"
#include "beaconless/core/suggest.hpp"

namespace beaconless {
namespace {

/// The shortest text that reads back as the same number.
std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

bool inside(double value, const Range& range) {
  return std::isfinite(value) && value >= range.low && value <= range.high;
}

Error not_allowed(const Field& field, std::string_view text) {
  return {field.name, "the value \"" + std::string(text) + "\" is not allowed",
          "allowed: " + field.allowed()};
}

std::string join(const Words& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " | ") + word;
  return text;
}

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // clang before 17 does not deduce it

}  // namespace

std::string Field::text() const {
  return std::visit(Overloaded{[](const double* v) { return shortest(*v); },
                               [](const int* v) { return std::to_string(*v); },
                               [](const bool* v) { return std::string(*v ? "true" : "false"); },
                               [](const std::string* v) { return *v; },
                               [this](const Choice& v) {
                                 const auto i = static_cast<std::size_t>(v.get());
                                 return i < words.size() ? words[i] : std::to_string(v.get());
                               }},
                    slot);
}

std::string Field::allowed() const {
  if (!words.empty()) return join(words);
  if (range) return shortest(range->low) + " … " + shortest(range->high);
  return "text";
}

std::optional<Error> Field::check() const {
  const bool good = std::visit(
      Overloaded{[this](const double* v) { return inside(*v, *range); },
                 [this](const int* v) { return inside(*v, *range); }, [](const bool*) { return true; },
                 [this](const std::string* v) {
                   return words.empty() || std::find(words.begin(), words.end(), *v) != words.end();
                 },
                 [this](const Choice& v) {
                   return v.get() >= 0 && static_cast<std::size_t>(v.get()) < words.size();
                 }},
      slot);
  if (good) return std::nullopt;
  return not_allowed(*this, text());
}

Result<Done> Field::set(std::string_view text) const {
  const auto word = std::find(words.begin(), words.end(), text);
  const bool good = std::visit(Overloaded{[&](double* v) {
                                            const auto number = parse_double(text);
                                            if (!number || !inside(*number, *range)) return false;
                                            *v = *number;
                                            return true;
                                          },
                                          [&](int* v) {
                                            const auto number = parse_int(text);
                                            if (!number || !inside(*number, *range)) return false;
                                            *v = *number;
                                            return true;
                                          },
                                          [&](bool* v) {
                                            if (word == words.end()) return false;
                                            *v = text == "true";
                                            return true;
                                          },
                                          [&](std::string* v) {
                                            if (!words.empty() && word == words.end()) return false;
                                            *v = text;
                                            return true;
                                          },
                                          [&](const Choice& v) {
                                            if (word == words.end()) return false;
                                            v.set(static_cast<int>(word - words.begin()));
                                            return true;
                                          }},
                               slot);
  if (!good) return not_allowed(*this, text);
  return Done{};
}

Result<Done> set_field(const std::vector<Field>& fields, std::string_view name, std::string_view value) {
  std::vector<std::string> names;
  for (const Field& field : fields) {
    if (field.name == name) return field.set(value);
    names.push_back(field.name);
  }
  const std::string near = nearest_word(name, names);
  return Error{std::string(name), "there is no such parameter",
               near.empty() ? "`beaconless params` lists all of them" : "did you mean \"" + near + "\"?"};
}

}  // namespace beaconless
