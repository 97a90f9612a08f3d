// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/world_frame.hpp"

#include <algorithm>

#include "beaconless/report/plot_area.hpp"
#include "beaconless/report/text.hpp"
#include "beaconless/report/ticks.hpp"

namespace beaconless::report {
namespace {

constexpr double kTop_px = 12.0;
constexpr double kRight_px = 16.0;
constexpr double kPhoneLetter_px = 15.0;
constexpr double kMarkSpacing_px = 90.0;
constexpr double kLeastHeight_px = 160.0;
constexpr double kScaleBar_ratio = 0.3;  // of the picture's width, at most

Axis marks(double low_m, double high_m, double px_per_m) {
  const double count = std::max(2.0, (high_m - low_m) * px_per_m / kMarkSpacing_px);
  return linear_axis(low_m, high_m, static_cast<int>(count), true);
}

}  // namespace

WorldView world_view(const Eigen::AlignedBox2d& bounds, double width_px, double max_height_px) {
  const double left =
      label_room_px(linear_axis(bounds.min().y(), bounds.max().y(), 6, true), kPhoneLetter_px);
  const double width = std::max(width_px - left - kRight_px, 50.0);
  const double most_height = std::max(max_height_px - kTop_px - kBelowWorld_px, 50.0);
  const Eigen::Vector2d size = bounds.sizes();
  const double scale = std::min(width / size.x(), most_height / size.y());
  const double height = std::clamp(scale * size.y(), std::min(kLeastHeight_px, most_height), most_height);
  const Eigen::Vector2d half(0.5 * width / scale, 0.5 * height / scale);
  return {bounds.center() - half, bounds.center() + half, {left, kTop_px}, scale};
}

void draw_world_grid(Svg& svg, const WorldView& view) {
  const Eigen::Vector2d end = view.bottom_right_px();
  PathData grid;
  for (const Tick& tick : marks(view.low_m.x(), view.high_m.x(), view.px_per_m).ticks) {
    const double at = view({tick.at, view.low_m.y()}).x();
    grid.move_to({at, view.top_left_px.y()});
    grid.line_to({at, end.y()});
    svg.text({at, end.y() + 8.0}, tick.label, "mid soft", TextSide::below);
  }
  for (const Tick& tick : marks(view.low_m.y(), view.high_m.y(), view.px_per_m).ticks) {
    const double at = view({view.low_m.x(), tick.at}).y();
    grid.move_to({view.top_left_px.x(), at});
    grid.line_to({end.x(), at});
    svg.text({view.top_left_px.x() - 8.0, at}, tick.label, "end soft", TextSide::middle);
  }
  svg.path(grid, "grid");
}

void draw_scale_bar(Svg& svg, const WorldView& view) {
  const Eigen::Vector2d end = view.bottom_right_px();
  const double length_m = round_below(kScaleBar_ratio * (view.high_m.x() - view.low_m.x()));
  const double length = length_m * view.px_per_m;
  const double y = end.y() + 60.0;
  PathData bar;
  for (const double x : {end.x() - length, end.x()}) {
    bar.move_to({x, y - 5.0});
    bar.line_to({x, y + 5.0});
  }
  bar.move_to({end.x() - length, y});
  bar.line_to({end.x(), y});
  svg.path(bar, "line thick ink");
  svg.text({end.x() - length - 10.0, y}, significant(length_m, 1) + " m", "end", TextSide::middle);
  constexpr double kSentence_px = 260.0;
  if (end.x() - length - view.top_left_px.x() > kSentence_px)
    svg.text({view.top_left_px.x(), y}, "x to the right, y up, in metres", "soft", TextSide::middle);
}

}  // namespace beaconless::report
