// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "words.hpp"

namespace beaconless::cli {

/// The words of `map build --slam`.
struct MapSlamWords {
  std::string recording;
  ScanWords scan;
  std::string method;  ///< "hector"
  std::string base_from_laser;
  std::string start;  ///< x,y,deg; "": the origin
  std::string out;
  std::string out_poses;
  std::string plot;                    ///< SVG
  std::optional<double> resolution_m;  ///< as told, if so; likewise the next two
  std::optional<double> p_occupied;
  std::optional<double> p_free;
  std::string config;
  std::vector<std::string> set;
};

/// Makes a map of a recording without poses, writes it and the poses, tells the result, and gives the exit
/// code.
int map_by_slam(const Console& console, const MapSlamWords& words);

}  // namespace beaconless::cli
