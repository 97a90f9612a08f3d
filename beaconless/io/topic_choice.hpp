// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Whether a topic holds scans, as a bag calls them or a log.
bool is_scan_topic(const Topic& topic);

/// Which of a recording's scan topics to read: the wanted one (a leading slash may be left out), or the only
/// one there is; "" when nothing is wanted and there is none, or several and scans are optional.
///
/// Errors: the wanted one is not there, several and none wanted; both list all there are.
Result<std::string> choose_scan_topic(const std::string& path, const RecordingOptions& options,
                                      std::span<const Topic> scan_topics);

}  // namespace beaconless::io
