// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/result.hpp"
#include "beaconless/geometry/pose2.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/scan_selection.hpp"
#include "beaconless/scan/scan.hpp"

#include "console.hpp"

namespace beaconless::cli {

/// Reads "x,y,deg" as people type a pose: metres, metres, degrees.
Result<Pose2> pose_from_words(std::string_view option, std::string_view text);

/// Applies `--set name=value` words one after the other.
Result<Done> set_parameters(const std::vector<Field>& fields, const std::vector<std::string>& pairs);

/// What keeps an option's text from being a finite number above 0 (or from 0 on); "" when nothing does.
std::string not_positive(const std::string& text);
std::string not_from_zero_on(const std::string& text);
std::string not_a_sweep(const std::string& text);

/// The options that say which scans of a recording to take, and how; shared by the verbs that read
/// recordings.
struct ScanWords {
  std::string topic;
  std::string scans;
  std::string stamp_is = "first";
  double sweep_time_s = 0.0;
  double min_range_m = 0.0;
  double max_range_m = 0.0;

  ScanGate gate() const;

  /// Errors: no slice, or one that takes no scan of any recording.
  Result<io::ScanSelection> selection() const;
};

/// Opens a recording to read its scans as the words say; its problems go to `problems`, which must live as
/// long.
Result<io::Recording> open_recording(const std::string& path, const ScanWords& words, ProblemLog& problems);

/// A file that is shipped with the program, by its path below data/; nothing when it is not to be found.
std::optional<std::string> shipped_file(const std::string& relative_path);

}  // namespace beaconless::cli
