// SPDX-License-Identifier: Apache-2.0
#include "localize_plan.hpp"

#include <cmath>

#include "beaconless/core/parse.hpp"

#include "localizer_config_of.hpp"

namespace beaconless::cli {
namespace {

constexpr double kFurthestAlone_m = 100.0;

Result<Alone> alone_from_words(const std::string& text) {
  const auto parts = split_words(text, ", ");
  const auto metres = parts.size() == 2 ? parse_double(parts[0]) : std::nullopt;
  const auto turn_deg = parts.size() == 2 ? parse_double(parts[1]) : std::nullopt;
  if (!metres || !turn_deg || !(std::abs(*metres) < kFurthestAlone_m) || !(std::abs(*turn_deg) <= 180.0))
    return Error{"--alone", "\"" + text + "\" is no distance and turn",
                 "write METRES,DEGREES, for example 0.3,10"};
  return Alone{*metres, radians(*turn_deg)};
}

/// Options that only mean something together with another.
Result<Done> check_together(const LocalizeWords& words, const LocalizePlan& plan) {
  if (plan.alone && words.start_from.empty())
    return Error{"--alone", "it needs a pose of every scan", "give --start-from REF.tum|recorded"};
  if (plan.alone && plan.windows)
    return Error{"--windows", "--alone takes every scan by itself already", "leave one of the two out"};
  if (plan.windows && (!plan.start || !std::holds_alternative<StartAnywhere>(*plan.start)))
    return Error{"--windows", "every window is to be found anew, without a pose",
                 "give --start auto or --start near:x,y,radius"};
  if (plan.windows || plan.alone)
    for (const auto& [option, value] : {std::pair{"--save-pose", words.save_pose},
                                        {"--blackbox", words.black_box},
                                        {"--out-mcap", words.out_mcap}})
      if (!value.empty())
        return Error{option, "there is no drive where scans are taken by themselves",
                     "leave it out, or --alone and --windows"};
  if (words.lasers.are_several() && !words.black_box.empty())
    return Error{"--blackbox", "it keeps the scans of one laser", "leave it out, or name one --topic"};
  return Done{};
}

}  // namespace

Result<LocalizePlan> plan_of(const LocalizeWords& words) {
  LocalizePlan plan;
  // 1. How.
  auto config = localizer_config_of(words);
  if (!config) return config.error();
  plan.config = *std::move(config);
  // 2. Which scans, from where.
  const auto scans = words.scan.selection();
  if (!scans) return scans.error();
  if (!words.lasers.are_several())
    plan.scans = *scans;  // else each laser's are selected where all are merged
  if (words.start.empty() == words.start_from.empty())
    return Error{"--start",
                 words.start.empty() ? "where the robot starts is not said"
                                     : "where the robot starts is said twice, by --start-from too",
                 "give --start x,y,deg|auto|near:x,y,radius|resume:FILE or --start-from REF.tum|recorded"};
  if (!words.start.empty()) {
    auto start = start_from_words(words.start);
    if (!start) return start.error();
    plan.start = *std::move(start);
  }
  if (!words.alone.empty()) {
    const auto alone = alone_from_words(words.alone);
    if (!alone) return alone.error();
    plan.alone = *alone;
  }
  if (!words.windows.empty()) {
    const auto windows = windows_from_words(words.windows);
    if (!windows) return windows.error();
    plan.windows = *windows;
  }
  if (auto together = check_together(words, plan); !together) return together.error();
  return plan;
}

}  // namespace beaconless::cli
