// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Core>

#include "beaconless/report/svg.hpp"
#include "beaconless/report/ticks.hpp"

namespace beaconless::report {

/// The box that a plot's values are drawn in, with its two axes.
struct PlotArea {
  Eigen::Vector2d low_px;   ///< upper left corner
  Eigen::Vector2d high_px;  ///< lower right corner
  Axis x;
  Axis y;

  /// The box of a picture of this size, with room for the labels of both axes on phones too.
  PlotArea(double width_px, double height_px, Axis x_axis, Axis y_axis);

  double x_px(double value) const { return low_px.x() + x.fraction(value) * (high_px.x() - low_px.x()); }
  double y_px(double value) const { return high_px.y() - y.fraction(value) * (high_px.y() - low_px.y()); }
  Eigen::Vector2d operator()(double x_value, double y_value) const { return {x_px(x_value), y_px(y_value)}; }

  /// Draws grid, marks and titles; what the axes measure stands above (y) and below (x), never on its side.
  void draw_axes(Svg& svg, const std::string& x_title, const std::string& y_title) const;
};

/// Pixels to keep free left of the marks of a vertical axis.
double label_room_px(const Axis& axis, double letter_px);

}  // namespace beaconless::report
