// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace beaconless {

/// The candidate that `word` was most likely meant to be, or "" when none is near (edit distance over half
/// the word).
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

}  // namespace beaconless
