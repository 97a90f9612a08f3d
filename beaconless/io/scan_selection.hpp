// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"

namespace beaconless::io {

/// Which scans of a recording to take, counted from 0 in the order of the file.
struct ScanSelection {
  std::uint64_t start = 0;
  std::uint64_t stop = std::numeric_limits<std::uint64_t>::max();  ///< the first that is no longer taken
  std::uint64_t step = 1;
  bool is_left_out = false;  ///< all but these are taken

  /// Reads a slice as Python writes it, "start:stop:step" with any part left out: "1::2", "0:100", ":50"; "5"
  /// is that one scan alone. "" takes all. A "^" before it takes all others: "^3::10" is what a map is made
  /// of that "3::10" is localized on.
  ///
  /// Errors: anything else; negative numbers, because a recording's end is not known while it is read; a step
  /// of 0.
  static Result<ScanSelection> parse(std::string_view text);

  bool wants(std::uint64_t scan) const {
    return (scan >= start && scan < stop && (scan - start) % step == 0) != is_left_out;
  }

  /// Whether no scan after this one is wanted, so that reading can stop.
  bool done_after(std::uint64_t scan) const {
    if (is_left_out) return false;
    if (stop <= start || scan >= stop - 1) return true;
    return scan >= start && (stop - 1 - start) / step == (scan - start) / step;
  }

  friend bool operator==(const ScanSelection&, const ScanSelection&) = default;
};

}  // namespace beaconless::io
