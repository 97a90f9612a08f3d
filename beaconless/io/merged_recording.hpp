// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/scan_selection.hpp"

namespace beaconless::io {

/// What one of several lasers has recorded; its scans are known by their frame.
struct LaserRecording {
  Recording recording;
  std::string frame_id;
};

/// One drive from several recordings of it, one a laser: their events by stamp, odometry and poses of the
/// first only. From each, `scans` selects.
///
/// Whose stamps run backwards keeps its own order. A scan whose frame is not that of its laser is passed over
/// and told as a Problem: it could not be told from those of another. In: at least one laser. Path and format
/// are those of the first, topics those of the first with its scan topic's messages counted for all.
Recording merge_recordings(std::vector<LaserRecording> lasers, const ScanSelection& scans,
                           std::function<void(const Problem&)> on_problem = {});

}  // namespace beaconless::io
