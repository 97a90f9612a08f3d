// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/scan_selection.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/localizer_config.hpp"
#include "beaconless/report/candidate_places.hpp"
#include "beaconless/report/run_report.hpp"

#include "console.hpp"

namespace beaconless::cli {

/// What a localizer made of a recording.
struct Replay {
  std::vector<PoseEstimate> estimates;         ///< one a scan that was taken
  std::vector<std::size_t> scan_indices;       ///< counted from 0 in the recording, one a scan that was taken
  std::vector<double> update_us;               ///< of update() alone, one a scan
  std::vector<report::PlacedScan> overlay;     ///< a few scans along the way, placed by their estimates
  std::vector<report::PlacedScan> good_scans;  ///< more of them, at poses that are ok
  std::vector<report::CandidatePlaces> places;  ///< those that fitted, while that was not clear
  std::uint64_t skipped_records = 0;
};

/// Where the robot is told to stand before a scan is fed; a scan without is left out.
using StartAt = std::function<std::optional<Pose2>(std::size_t scan_index, Stamp stamp)>;

/// Who else hears what comes in and what came of it.
using HeardBy = std::function<void(const Event& event, const PoseEstimate& estimate)>;

/// Feeds the events of a recording to a localizer, scans by the selection. `config` tells where lasers sit.
Replay replay(const io::Recording& recording, const io::ScanSelection& scans, Localizer& localizer,
              const LocalizerConfig& config, const Console& console, const StartAt& start_at = {},
              const HeardBy& heard_by = {});

}  // namespace beaconless::cli
