// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace beaconless {

/// A moment, in whole nanoseconds since the recording's own zero (usually 1970).
struct Stamp {
  std::int64_t ns = 0;

  /// The nearest nanosecond. Doubles of UNIX seconds are good to about 0.2 microseconds only.
  static Stamp from_seconds(double seconds_s);

  double seconds() const { return static_cast<double>(ns) * 1e-9; }
  friend constexpr auto operator<=>(const Stamp&,
                                    const Stamp&) = default;  // NOLINT(modernize-use-nullptr): its bug
};

/// Seconds from `earlier` to `later`; negative when the order is the other way round.
double seconds_between(Stamp earlier, Stamp later);

/// The moment `seconds_s` later, to the nanosecond; stays inside what a Stamp can hold.
Stamp operator+(Stamp stamp, double seconds_s);

/// Reads decimal seconds ("1411657682.042859", "-0.5", "12") without passing through a double.
///
/// Digits past the ninth decimal are dropped; exponents are accepted through a double. Anything else, a value
/// outside int64 nanoseconds included, gives nothing.
std::optional<Stamp> parse_stamp(std::string_view text);

/// Decimal seconds with nine decimals.
std::string to_string(Stamp stamp);

inline std::ostream& operator<<(std::ostream& out, Stamp stamp) { return out << to_string(stamp); }

}  // namespace beaconless
