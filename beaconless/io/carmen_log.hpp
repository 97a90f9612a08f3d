// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"

namespace beaconless::io {

/// Whether a line beginning with this word is at home in a CARMEN log.
bool is_carmen_keyword(std::string_view keyword);

/// Opens a CARMEN log, plain or gzip; `topic` chooses a keyword where several carry scans.
///
/// A laser line with poses gives a ReferencePose directly before its Scan, with the same stamp and
/// base_from_laser as far as the line tells the two apart. ODOM gives Odometry, TRUEPOS a ReferencePose;
/// other keywords (VERTEX2, EDGE2, NEFF, SYNC …) are passed over silently. The stamp is the message's own,
/// not the logger's. A last line without its line end is read only if it ends with a host and a stamp: else
/// it was cut. Cost: one pass over the file here, to count the keywords.
Result<Recording> open_carmen_log(const std::string& path, const RecordingOptions& options = {});

}  // namespace beaconless::io
