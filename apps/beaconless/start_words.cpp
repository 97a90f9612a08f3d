// SPDX-License-Identifier: Apache-2.0
#include "start_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "beaconless/core/parse.hpp"
#include "beaconless/core/suggest.hpp"

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

/// What was probably meant, or "": a word in capitals, or one with a letter wrong.
std::string meant_by(std::string_view text) {
  static const std::array<std::string, 3> kWords{"auto", "near:", "resume:"};
  const std::size_t colon = text.find(':');
  std::string word(text.substr(0, colon == std::string_view::npos ? colon : colon + 1));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  std::string meant = nearest_word(word, kWords);
  if (meant.ends_with(':')) meant += text.substr(word.size());
  return meant;
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
  const std::string meant = meant_by(text);
  return wrong(text, "is no start",
               (meant.empty() ? "" : "did you mean \"" + meant + "\"? ") +
                   std::string("write x,y,deg (metres, metres, degrees, for example 1.2,3.4,90), auto, "
                               "near:x,y,radius or resume:FILE"));
}

}  // namespace beaconless::cli
