// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "beaconless/report/picture.hpp"

namespace beaconless::report {

/// Places on a map that have a meaning in common: people, corners, where robots stand.
struct MapMarks {
  std::string name;                     ///< as in the legend
  std::vector<Eigen::Vector2d> points;  ///< map frame, metres
  Colour colour = Colour::red;
  Mark mark = Mark::ring;  ///< ring, square, dots, or outline: a disc of radius_m at the map's scale
  double radius_m = 0.0;
  std::vector<double> headings_rad = {};  ///< one for each point that looks somewhere; may be shorter
  std::vector<std::string> labels = {};   ///< likewise: words beside the points
};

/// Draws the marks, their headings and labels, and adds them to the legend; points that are not finite are
/// left out.
void draw_marks(Picture& picture, const WorldView& view, const MapMarks& marks);

}  // namespace beaconless::report
