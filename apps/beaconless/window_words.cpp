// SPDX-License-Identifier: Apache-2.0
#include "window_words.hpp"

#include "beaconless/core/parse.hpp"

namespace beaconless::cli {
namespace {

constexpr std::size_t kLongest = 100'000;  // scans of a window are kept

}  // namespace

Result<Windows> windows_from_words(std::string_view text) {
  const auto colon = text.find(':');
  const auto number = [](std::string_view word) { return parse_int<std::size_t>(word); };
  const auto length = number(text.substr(0, colon));
  const auto stride = colon == std::string_view::npos ? std::nullopt : number(text.substr(colon + 1));
  if (!length || !stride || *length < 1 || *stride < 1 || *length > kLongest)
    return Error{"--windows", "\"" + std::string(text) + "\" is no length and stride",
                 "write LENGTH:STRIDE in scans, for example 5:20"};
  return Windows{*length, *stride};
}

}  // namespace beaconless::cli
