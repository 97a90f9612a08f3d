// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/plot_area.hpp"

#include <algorithm>

namespace beaconless::report {
namespace {

constexpr double kTop_px = 34.0;
constexpr double kRight_px = 22.0;
constexpr double kBottom_px = 54.0;
constexpr double kPhoneLetter_px = 11.5;  // of the larger font that a phone shows

}  // namespace

double label_room_px(const Axis& axis, double letter_px) {
  std::size_t longest = 1;
  for (const Tick& tick : axis.ticks) longest = std::max(longest, tick.label.size());
  return 16.0 + letter_px * static_cast<double>(longest);
}

PlotArea::PlotArea(double width_px, double height_px, Axis x_axis, Axis y_axis)
    : x(std::move(x_axis)), y(std::move(y_axis)) {
  low_px = {label_room_px(y, kPhoneLetter_px), kTop_px};
  high_px = {std::max(width_px - kRight_px, low_px.x() + 10.0),
             std::max(height_px - kBottom_px, kTop_px + 10.0)};
}

void PlotArea::draw_axes(Svg& svg, const std::string& x_title, const std::string& y_title) const {
  PathData grid;
  for (const Tick& tick : x.ticks) {
    const double at = x_px(tick.at);
    grid.move_to({at, low_px.y()});
    grid.line_to({at, high_px.y()});
    svg.text({at, high_px.y() + 8.0}, tick.label, "mid soft", TextSide::below);
  }
  for (const Tick& tick : y.ticks) {
    const double at = y_px(tick.at);
    grid.move_to({low_px.x(), at});
    grid.line_to({high_px.x(), at});
    svg.text({low_px.x() - 8.0, at}, tick.label, "end soft", TextSide::middle);
  }
  svg.path(grid, "grid");
  svg.line({low_px.x(), high_px.y()}, high_px, "axis");
  svg.text({2.0, 18.0}, y_title, "title");
  svg.text({high_px.x(), high_px.y() + 32.0}, x_title, "end soft", TextSide::below);
}

}  // namespace beaconless::report
