// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "console.hpp"
#include "laser_set.hpp"
#include "words.hpp"

namespace beaconless::cli {

/// The words of `beaconless localize`.
struct LocalizeWords {
  std::string recording;
  std::string map;
  ScanWords scan;
  std::string method;
  std::string preset;
  std::string line_fit;
  std::string loss;
  std::string base_from_laser;
  LaserWords lasers;  ///< where there are several
  std::string start;
  std::string start_from;
  std::string pose_topic;
  std::string reference;
  std::string alone;
  std::string windows;
  std::string save_pose;
  std::string black_box;
  std::string out_mcap;
  std::string config;
  std::vector<std::string> set;
  double sigma_m = 0.0;  ///< 0: the config's
  std::string out;
  std::string title;
  std::string command_line;
};

/// Localizes a recording and writes what came of it; gives the exit code.
int localize_run(const Console& console, const LocalizeWords& words);

}  // namespace beaconless::cli
