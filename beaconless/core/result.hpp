// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace beaconless {

/// What went wrong outside the program: a file, a format, a configuration.
struct Error {
  std::string where;   ///< path, with ":line" or "@byte" where known; or the name of a field
  std::string what;    ///< what is wrong, with the value that was met
  std::string remedy;  ///< what the reader of the message can do about it; may be empty

  friend bool operator==(const Error&, const Error&) = default;
};

/// One line for people: "where: what (remedy)".
inline std::string to_string(const Error& error) {
  std::string text = error.where.empty() ? error.what : error.where + ": " + error.what;
  if (!error.remedy.empty()) text += " (" + error.remedy + ")";
  return text;
}

inline std::ostream& operator<<(std::ostream& out, const Error& error) { return out << to_string(error); }

/// Thrown by Result::value() when there is none: the caller chose not to look.
class BadResult : public std::runtime_error {
 public:
  explicit BadResult(const Error& error) : std::runtime_error(to_string(error)) {}
};

/// A value, or the Error that kept it from being made.
///
/// `value()` on a temporary returns by value, so that `for (auto& e : open(path).value())` is safe.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor): values convert
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor): errors convert

  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    if (!ok()) throw BadResult(error());
    return std::get<T>(state_);
  }
  T& value() & {
    if (!ok()) throw BadResult(error());
    return std::get<T>(state_);
  }
  T value() && {
    if (!ok()) throw BadResult(error());
    return std::get<T>(std::move(state_));
  }
  const T& operator*() const& { return value(); }
  T operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success without a value.
struct Done {
  friend bool operator==(Done, Done) = default;
};

}  // namespace beaconless
