// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "beaconless/io/recording.hpp"
#include "beaconless/io/scan_selection.hpp"

namespace beaconless::io {

/// One drive from several recordings of it, one a laser: their events by stamp, odometry and poses of the
/// first only. From each, `scans` selects.
///
/// Whose stamps run backwards keeps its own order. In: at least one. Path and format are those of the first,
/// topics those of the first with its scan topic's messages counted for all.
Recording merge_recordings(std::vector<Recording> recordings, const ScanSelection& scans);

}  // namespace beaconless::io
