// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "beaconless/report/svg.hpp"

namespace beaconless::report {

/// Room below a drawing of the world for its marks and scale bar.
inline constexpr double kBelowWorld_px = 92.0;

/// A view of `bounds` at one scale, widened where the picture's shape leaves room. The room for the marks of
/// the y axis depends on its labels, so that is decided first.
WorldView world_view(const Eigen::AlignedBox2d& bounds, double width_px, double max_height_px);

/// Lines every so many metres, with what they stand for.
void draw_world_grid(Svg& svg, const WorldView& view);

/// A bar of a round length below the drawing, and which way the axes run.
void draw_scale_bar(Svg& svg, const WorldView& view);

}  // namespace beaconless::report
