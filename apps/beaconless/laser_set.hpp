// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/io/merged_recording.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/localize/localizer_config.hpp"

#include "console.hpp"
#include "words.hpp"

namespace beaconless::cli {

/// What the words tell of lasers: `--topic` and `--base-from-laser`, once, or once for each of several.
struct LaserWords {
  std::vector<std::string> topics;
  std::vector<std::string> places;  ///< x,y,deg

  bool are_several() const { return topics.size() > 1 || places.size() > 1; }

  /// What is told of the only one, to where the words of one laser stand; nothing where there are several.
  void settle_one(std::string& topic, std::string& place) const;
};

/// Several lasers of one recording, opened as one.
struct LaserSet {
  io::Recording recording;  ///< of all their scans
  std::vector<LaserOnRobot> lasers;
};

/// Opens a recording once for each of several topics, whose scans are told apart by their frames.
///
/// Errors: those of open_recording, a topic that is named twice or has no scans, scans without a
/// frame, two topics of one frame.
Result<std::vector<io::LaserRecording>> open_each(const std::string& path, const ScanWords& words,
                                                  const std::vector<std::string>& topics,
                                                  ProblemLog& problems);

/// Opens a recording to read the scans of several topics; where each laser sits is told by the words'
/// places, in the order of the topics, or, where there are none, by the recording.
///
/// Errors: those of open_each, and a laser whose place nobody tells.
Result<LaserSet> open_lasers(const std::string& path, const ScanWords& words, const LaserWords& told,
                             ProblemLog& problems);

}  // namespace beaconless::cli
