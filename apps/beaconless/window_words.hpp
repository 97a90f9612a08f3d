// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "beaconless/core/result.hpp"

namespace beaconless::cli {

/// Pieces of a recording that are localized each by itself: `length` scans from every `stride`-th on.
struct Windows {
  std::size_t length = 1;
  std::size_t stride = 1;
};

/// Reads "LENGTH:STRIDE", both counted in scans. Errors: anything else, and numbers below 1.
Result<Windows> windows_from_words(std::string_view text);

}  // namespace beaconless::cli
