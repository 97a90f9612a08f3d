// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::cli {

/// Reads "x,y,deg" as people type a pose: metres, metres, degrees.
Result<Pose2> pose_from_words(std::string_view option, std::string_view text);

/// The options that say which scans of a recording to take, and how; shared by the verbs that read
/// recordings.
struct ScanWords {
  std::string topic;
  std::string scans;
  std::string stamp_is = "first";
  double min_range_m = 0.0;
  double max_range_m = 0.0;

  ScanGate gate() const;
};

/// A file that is shipped with the program, by its path below data/; nothing when it is not to be found.
std::optional<std::string> shipped_file(const std::string& relative_path);

}  // namespace beaconless::cli
