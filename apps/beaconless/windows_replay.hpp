// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/scan_selection.hpp"
#include "beaconless/localize/localizer.hpp"

#include "console.hpp"
#include "start_words.hpp"
#include "window_words.hpp"

namespace beaconless::cli {

/// What a localizer made of one window: its belief after the last scan.
struct WindowFound {
  std::size_t first_scan = 0;  ///< counted from 0 in the recording
  std::size_t last_scan = 0;
  PoseEstimate estimate;
  std::vector<PoseCandidate> candidates;
  double took_us = 0.0;  ///< all of its updates together
};

/// What became of all windows.
struct WindowsReplay {
  std::vector<WindowFound> windows;  ///< in the order of the recording; only those that are full
  std::uint64_t skipped_records = 0;
};

/// Localizes every window of a recording by itself: `start_anywhere` before its first scan, then its events.
///
/// Windows are of the scans that the selection takes. Memory: the events of one window.
WindowsReplay replay_windows(const io::Recording& recording, const io::ScanSelection& scans,
                             Localizer& localizer, const StartAnywhere& start, const Windows& windows,
                             const Console& console);

}  // namespace beaconless::cli
