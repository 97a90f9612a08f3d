// SPDX-License-Identifier: Apache-2.0
#include "start_words.hpp"

#include <cmath>

#include "beaconless/core/parse.hpp"

#include "words.hpp"

namespace beaconless::cli {
namespace {

constexpr double kFarthest_m = 1e7;  // nobody means more

Error wrong(std::string_view text, const std::string& what, const std::string& remedy) {
  return {"--start", "\"" + std::string(text) + "\" " + what, remedy};
}

Result<Start> near_from_words(std::string_view text, std::string_view disc) {
  const auto words = split_words(disc, ", ");
  const Error error =
      wrong(text, "is no region", "write near:x,y,radius in metres, for example near:1.2,3.4,5");
  if (words.size() != 3) return error;
  double numbers[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parse_double(words[i]);
    if (!number || !(std::abs(*number) < kFarthest_m)) return error;
    numbers[i] = *number;
  }
  if (!(numbers[2] > 0.0)) return wrong(text, "has no radius above 0", error.remedy);
  return Start{StartAnywhere{SearchRegion{{numbers[0], numbers[1]}, numbers[2]}}};
}

}  // namespace

Result<Start> start_from_words(std::string_view text) {
  const auto rest_of = [&](std::string_view word) { return text.substr(word.size()); };
  if (text == "auto") return Start{StartAnywhere{}};
  if (text.starts_with("near:")) return near_from_words(text, rest_of("near:"));
  if (text == "near") return near_from_words(text, "");
  if (text == "resume" || text == "resume:")
    return wrong(text, "names no file", "write resume:FILE with a file that --save-pose wrote");
  if (text.starts_with("resume:")) return Start{StartResumed{std::string(rest_of("resume:"))}};
  if (const auto pose = pose_from_words("--start", text)) return Start{StartHere{*pose}};
  return wrong(text, "is no start",
               "write x,y,deg (metres, metres, degrees, for example 1.2,3.4,90), auto, near:x,y,radius or "
               "resume:FILE");
}

}  // namespace beaconless::cli
