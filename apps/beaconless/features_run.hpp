// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/features/detector.hpp"

#include "console.hpp"
#include "words.hpp"

namespace beaconless::cli {

/// The words of `beaconless features`.
struct FeaturesWords {
  std::string recording;
  std::vector<std::string> detectors{"corners", "falko"};
  std::string csv;
  std::string plot;
  int plotted_scan = -1;  ///< -1: the first that is taken
  std::string sweep;
  std::string preset = "beaconless";
  std::vector<std::string> set;
  std::string reference;
  std::string pose_topic;
  std::string base_from_laser;
  int gap = 10;
  double within_m = 0.1;
  ScanWords scan;
};

/// Runs detectors over a recording; gives the exit code.
int features_run(const Console& console, const FeaturesWords& words);

}  // namespace beaconless::cli
