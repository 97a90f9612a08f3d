// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "poses_of.hpp"
#include "windows_replay.hpp"

namespace beaconless::cli {

/// How a window ended, seen from where the robot really was.
enum class Outcome : int {
  correct,    ///< ok, within 0.3 m and 3 degrees
  wrong,      ///< ok, and it is not there: the one thing that must not happen
  ambiguous,  ///< relocalizing: several places fit
  degraded,   ///< a pose that does not claim to be good
  lost,       ///< it said so
  untold,     ///< there is no reference at its last scan, or it was not started
};

std::string_view to_string(Outcome outcome);

/// Errors up to these are correct: the place is found, and a tracker goes on from there.
inline constexpr double kCorrect_m = 0.3;
inline constexpr double kCorrect_deg = 3.0;

/// A window beside the truth.
struct JudgedWindow {
  WindowFound found;
  Outcome outcome = Outcome::untold;
  std::optional<Pose2> truth;
  bool is_among_candidates = false;  ///< one of the places that fit is the right one
};

/// Judges windows; `reference` may be nullptr.
std::vector<JudgedWindow> judge_windows(const std::vector<WindowFound>& found, const PosesOf* reference);

/// {"length", "stride", "count", "outcomes", "ambiguous_with_truth", "wrong", "took_ms"}
nlohmann::json summary_of(const std::vector<JudgedWindow>& windows, const Windows& asked);

/// For people: how many ended how, and which were wrong.
std::vector<std::string> lines_of(const std::vector<JudgedWindow>& windows, bool has_reference);

/// One line a window: scans, stamp, pose, status, quality, outcome, errors, number of candidates.
std::string csv_of(const std::vector<JudgedWindow>& windows);

}  // namespace beaconless::cli
