// SPDX-License-Identifier: Apache-2.0
#include "beaconless/core/stamp.hpp"

#include <cmath>
#include <limits>

#include "beaconless/core/parse.hpp"

namespace beaconless {
namespace {

constexpr std::int64_t kNanosPerSecond = 1'000'000'000;
constexpr double kMaxSeconds_s = 9.2e9;  // int64 nanoseconds end near the year 2262

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

Stamp Stamp::from_seconds(double seconds_s) {
  if (!std::isfinite(seconds_s)) return {};
  if (seconds_s > kMaxSeconds_s) seconds_s = kMaxSeconds_s;
  if (seconds_s < -kMaxSeconds_s) seconds_s = -kMaxSeconds_s;
  return {std::llround(seconds_s * 1e9)};
}

double seconds_between(Stamp earlier, Stamp later) {
  std::int64_t ns = 0;
  if (__builtin_sub_overflow(later.ns, earlier.ns, &ns)) return later.seconds() - earlier.seconds();
  return static_cast<double>(ns) * 1e-9;
}

Stamp operator+(Stamp stamp, double seconds_s) {
  const std::int64_t added = Stamp::from_seconds(seconds_s).ns;
  std::int64_t ns = 0;
  if (!__builtin_add_overflow(stamp.ns, added, &ns)) return {ns};
  return {added > 0 ? std::numeric_limits<std::int64_t>::max() : std::numeric_limits<std::int64_t>::min()};
}

std::optional<Stamp> parse_stamp(std::string_view text) {
  const std::string_view whole = text;
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);

  std::int64_t seconds = 0;
  std::size_t digits = 0;
  for (; digits < text.size() && is_digit(text[digits]); ++digits) {
    seconds = seconds * 10 + (text[digits] - '0');
    if (seconds > static_cast<std::int64_t>(kMaxSeconds_s)) return std::nullopt;
  }
  std::size_t i = digits;
  std::int64_t nanos = 0;
  if (i < text.size() && text[i] == '.') {
    ++i;
    for (std::int64_t unit = kNanosPerSecond / 10; i < text.size() && is_digit(text[i]); ++i, ++digits) {
      nanos += unit * (text[i] - '0');
      unit /= 10;
    }
  }
  if (digits == 0) return std::nullopt;
  if (i < text.size()) {  // an exponent, or not a number at all
    const auto seconds_s = parse_double(whole);
    if (!seconds_s || !std::isfinite(*seconds_s) || std::abs(*seconds_s) > kMaxSeconds_s) return std::nullopt;
    return Stamp::from_seconds(*seconds_s);
  }
  const std::int64_t total = seconds * kNanosPerSecond + nanos;
  return Stamp{negative ? -total : total};
}

std::string to_string(Stamp stamp) {
  const bool negative = stamp.ns < 0;
  const auto magnitude =
      negative ? 0 - static_cast<std::uint64_t>(stamp.ns) : static_cast<std::uint64_t>(stamp.ns);
  std::string decimals = std::to_string(magnitude % kNanosPerSecond);
  decimals.insert(0, 9 - decimals.size(), '0');
  return (negative ? "-" : "") + std::to_string(magnitude / kNanosPerSecond) + "." + decimals;
}

}  // namespace beaconless
