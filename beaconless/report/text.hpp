// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace beaconless::report {

/// The same text for the inside of an element or a quoted attribute, of XML as of HTML.
///
/// Control characters, which XML forbids, are dropped; bytes that are no UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// A coordinate: at most `decimals`, no trailing zeros, never "-0", never more than ±1e7; 0 for what is not
/// finite.
std::string number(double value, int decimals = 2);

/// A value for reading, to so many significant digits and without an exponent where that is short; "–" for
/// NaN and inf.
std::string significant(double value, int digits = 3);

/// A count with its thousands set apart by narrow spaces from five digits on: 4000, 100 000.
std::string grouped(std::uint64_t count);

}  // namespace beaconless::report
