// SPDX-License-Identifier: Apache-2.0
#include "words.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "beaconless/core/parse.hpp"

namespace beaconless::cli {
namespace {

constexpr double kFarthest = 1e7;  // metres or degrees; nobody means more

}  // namespace

Result<Done> set_parameters(const std::vector<Field>& fields, const std::vector<std::string>& pairs) {
  for (const std::string& pair : pairs) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos)
      return Error{"--set " + pair, "there is no \"=\"", "write --set name=value"};
    if (auto set = set_field(fields, pair.substr(0, equals), pair.substr(equals + 1)); !set)
      return set.error();
  }
  return Done{};
}

Result<Pose2> pose_from_words(std::string_view option, std::string_view text) {
  const auto words = split_words(text, ", ");
  const Error error{std::string(option), "\"" + std::string(text) + "\" is no pose",
                    "write x,y,deg: metres, metres, degrees, for example 1.2,3.4,90"};
  if (words.size() != 3) return error;
  double numbers[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parse_double(words[i]);
    if (!number || !(std::abs(*number) < kFarthest)) return error;
    numbers[i] = *number;
  }
  return Pose2{numbers[0], numbers[1], wrap_angle(radians(numbers[2]))};
}

std::string not_positive(const std::string& text) {
  const auto number = parse_double(text);
  return number && std::isfinite(*number) && *number > 0.0 ? "" : "\"" + text + "\" is no number above 0";
}

std::string not_from_zero_on(const std::string& text) {
  const auto number = parse_double(text);
  return number && std::isfinite(*number) && *number >= 0.0 ? "" : "\"" + text + "\" is no number from 0 on";
}

std::string not_a_sweep(const std::string& text) {
  const auto number = parse_double(text);
  return number && *number >= 0.0 && *number < 60.0
             ? ""
             : "\"" + text + "\" is no time of a sweep, from 0 to 60 s";
}

ScanGate ScanWords::gate() const {
  return {.stamp_is = stamp_is == "last"     ? StampIs::last_beam
                      : stamp_is == "middle" ? StampIs::middle_beam
                                             : StampIs::first_beam,
          .sweep_time_s = sweep_time_s,
          .range_min_m = static_cast<float>(min_range_m),
          .range_max_m = static_cast<float>(max_range_m)};
}

Result<io::ScanSelection> ScanWords::selection() const {
  auto selection = io::ScanSelection::parse(scans);
  if (!selection) return Error{"--scans", selection.error().what, selection.error().remedy};
  if (selection->start >= selection->stop && !selection->is_left_out)
    return Error{"--scans", "\"" + scans + "\" takes no scan", "write start:stop with start below stop"};
  return selection;
}

Result<io::Recording> open_recording(const std::string& path, const ScanWords& words, ProblemLog& problems) {
  return io::open_recording(path, {.topic = words.topic,
                                   .gate = words.gate(),
                                   .on_problem = [&problems](const io::Problem& p) { problems.add(p); }});
}

std::optional<std::string> shipped_file(const std::string& relative_path) {
  std::string places = BEACONLESS_DATA_DIRS;
  if (const char* chosen = std::getenv("BEACONLESS_SHARE")) places = std::string(chosen) + ":" + places;
  for (const auto place : split_words(places, ":")) {
    const auto path = std::filesystem::path(place) / relative_path;
    if (std::filesystem::exists(path)) return path.string();
  }
  return std::nullopt;
}

}  // namespace beaconless::cli
