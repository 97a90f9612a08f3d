// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "beaconless/core/result.hpp"

namespace beaconless {

/// The values a numeric field may take; both ends belong to it.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// The words an enumeration field may take, in the order of the enumerators.
using Words = std::vector<std::string>;

/// An enumeration seen as the position of its word.
struct Choice {
  std::function<int()> get;
  std::function<void(int)> set;
};

/// One described field of a config: its name, where its value lives, what it may be, and what it is for.
struct Field {
  using Slot = std::variant<double*, int*, bool*, std::string*, Choice>;

  std::string name;  ///< "icp.max_pair_distance_m"
  Slot slot;         ///< points into the config that was described
  std::optional<Range> range;
  Words words;           ///< for enumerations, and for strings with a closed list
  std::string sentence;  ///< what it is for

  /// The value as people type it.
  std::string text() const;

  /// Sets the value from text; an Error names the field, the value met and what is allowed, and changes
  /// nothing.
  Result<Done> set(std::string_view text) const;

  /// "0.01 … 10", "huber | cauchy | tukey", "true | false" or "text".
  std::string allowed() const;

  /// What is wrong with the present value, if anything.
  std::optional<Error> check() const;
};

/// Collects the fields of a config; handed to `describe(fields, config)`.
///
/// A config is a plain struct. Beside it stands `void describe(Fields&, Config&)`, the one place where its
/// names, ranges and sentences are written; reading, checking, dumping, help and documentation all come from
/// there, and defaults from the struct itself.
class Fields {
 public:
  void operator()(std::string_view name, double& value, Range range, std::string_view sentence) {
    add({full(name), &value, range, {}, std::string(sentence)});
  }
  void operator()(std::string_view name, int& value, Range range, std::string_view sentence) {
    add({full(name), &value, range, {}, std::string(sentence)});
  }
  void operator()(std::string_view name, bool& value, std::string_view sentence) {
    add({full(name), &value, std::nullopt, {"false", "true"}, std::string(sentence)});
  }
  void operator()(std::string_view name, std::string& value, Words words, std::string_view sentence) {
    add({full(name), &value, std::nullopt, std::move(words), std::string(sentence)});
  }
  /// An enumeration whose enumerators count from 0 as `words` do.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(std::string_view name, Enum& value, Words words, std::string_view sentence) {
    add({full(name),
         Choice{[&value] { return static_cast<int>(value); },
                [&value](int i) { value = static_cast<Enum>(i); }},
         std::nullopt, std::move(words), std::string(sentence)});
  }
  /// A config inside a config: its fields are named "section.field". `settled` are fields that the outer
  /// config decides and nobody may set.
  template <class Config>
  void section(std::string_view name, Config& config, std::initializer_list<std::string_view> settled = {}) {
    const std::string outer = prefix_;
    prefix_ = full(name) + ".";
    describe(*this, config);
    for (const std::string_view field : settled)
      std::erase_if(list_, [&](const Field& of) { return of.name == full(field); });
    prefix_ = outer;
  }

  const std::vector<Field>& list() const { return list_; }

 private:
  std::string full(std::string_view name) const { return prefix_ + std::string(name); }
  void add(Field field) { list_.push_back(std::move(field)); }

  std::string prefix_;
  std::vector<Field> list_;
};

/// All fields of `config`, which must outlive them.
template <class Config>
std::vector<Field> fields_of(Config& config) {
  Fields fields;
  describe(fields, config);
  return fields.list();
}

/// Sets one field by name; an unknown name is refused with the nearest known one.
Result<Done> set_field(const std::vector<Field>& fields, std::string_view name, std::string_view value);

/// The first field whose value is not allowed, as an Error; Done when all are.
template <class Config>
Result<Done> check_config(const Config& config) {
  Config copy = config;
  for (const Field& field : fields_of(copy))
    if (auto error = field.check()) return *error;
  return Done{};
}

}  // namespace beaconless
