// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "beaconless/io/scan_selection.hpp"
#include "beaconless/localize/localizer_config.hpp"

#include "localize_run.hpp"
#include "start_words.hpp"
#include "window_words.hpp"

namespace beaconless::cli {

/// How far from its pose each scan starts that is taken by itself.
struct Alone {
  double metres = 0.0;
  double turn_rad = 0.0;
};

/// What the words of `localize` ask for, before any file is opened but that of parameters.
struct LocalizePlan {
  LocalizerConfig config;
  io::ScanSelection scans;
  std::optional<Start> start;  ///< nothing: from the poses of --start-from
  std::optional<Alone> alone;
  std::optional<Windows> windows;
};

/// Errors: words that mean nothing, contradict each other, or have no effect.
Result<LocalizePlan> plan_of(const LocalizeWords& words);

}  // namespace beaconless::cli
