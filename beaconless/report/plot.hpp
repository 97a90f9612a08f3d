// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "beaconless/report/picture.hpp"

namespace beaconless::report {

/// One curve of a plot. A value that is not finite is a gap.
struct Series {
  std::string name;  ///< as in the legend; "" keeps it out
  Colour colour = Colour::blue;
  Mark mark = Mark::line;  ///< line, thin (for what is noisy), dashed or dots
  std::vector<double> x;   ///< any order
  std::vector<double> y;   ///< same length; what is longer is cut off
};

/// A stretch of x that is coloured from top to bottom.
struct Shade {
  double from = 0.0;
  double to = 0.0;
  std::string name;
  Colour colour = Colour::grey;
};

/// A value that a straight line marks.
struct Level {
  double at = 0.0;
  std::string name;
};

/// What a plot shows. Titles end with their unit in brackets: "position error [mm]".
struct Plot {
  std::string x_title;
  std::string y_title;
  bool log_y = false;
  std::optional<double> y_low;  ///< an end of the y axis that does not follow from the values
  std::optional<double> y_high;
  std::vector<Series> series;
  std::vector<Shade> shades;
  std::optional<Level> level;  ///< across
};

struct PlotConfig {
  double width_px = 680.0;
  double height_px = 270.0;
};

/// Draws curves over their x axis, thinned to what the picture can show: one spike in 100 000 points stays.
///
/// In: anything; without a single finite value it says so. Cost: O(n log n) where x is not ascending, else
/// O(n).
Picture draw_plot(const Plot& plot, const PlotConfig& config = {});

/// Draws how often values fall where; `markers` are lines with their names, for medians and percentiles, in
/// ascending order.
///
/// Values far beyond the rest (more than 1.5 times the 99th percentile) are not drawn but counted in the
/// picture. In: values in the unit that `x_title` names, `what` they are ("scans"). Cost: O(n).
Picture draw_histogram(std::span<const double> values, const std::string& x_title, const std::string& what,
                       std::span<const Level> markers = {}, const PlotConfig& config = {});

}  // namespace beaconless::report
