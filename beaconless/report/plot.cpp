// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "beaconless/report/plot_area.hpp"
#include "beaconless/report/text.hpp"
#include "beaconless/report/thin.hpp"

namespace beaconless::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The smallest and largest finite value met.
struct Extent {
  double low = kInfinity;
  double high = -kInfinity;

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

/// The points that have an x, in its order.
Series in_order(const Series& series) {
  const std::size_t count = std::min(series.x.size(), series.y.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i)
    if (std::isfinite(series.x[i])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return series.x[a] < series.x[b]; });
  Series sorted{series.name, series.colour, series.mark, {}, {}};
  for (const std::size_t i : order) {
    sorted.x.push_back(series.x[i]);
    sorted.y.push_back(series.y[i]);
  }
  return sorted;
}

void draw_series(Svg& svg, const PlotArea& area, const Series& series) {
  const auto columns = static_cast<std::size_t>(area.high_px.x() - area.low_px.x());
  PathData data;
  for (const std::size_t i : thin(series.x, series.y, columns)) {
    const Eigen::Vector2d at = area(series.x[i], series.y[i]);
    if (series.mark == Mark::dots)
      data.dot(at);
    else
      data.line_to(at);
  }
  const std::string kind = series.mark == Mark::dots     ? "dots "
                           : series.mark == Mark::dashed ? "line dashed "
                           : series.mark == Mark::thin   ? "line thin "
                                                         : "line ";
  svg.path(data, kind + std::string(to_string(series.colour)));
}

Axis y_axis_of(const Plot& plot, const std::vector<Series>& series) {
  Extent extent;
  for (const Series& one : series)
    for (const double value : one.y)
      if (!plot.log_y || value > 0.0) extent.add(value);
  if (plot.level && (!plot.log_y || plot.level->at > 0.0)) extent.add(plot.level->at);
  if (plot.log_y) return log_axis(plot.y_low.value_or(extent.low), plot.y_high.value_or(extent.high));
  extent.add(plot.y_low.value_or(kInfinity));
  extent.add(plot.y_high.value_or(kInfinity));
  return linear_axis(extent.low, extent.high, 4);
}

void add_once(std::vector<LegendEntry>& legend, const LegendEntry& entry) {
  const bool known =
      std::any_of(legend.begin(), legend.end(), [&](const LegendEntry& e) { return e.text == entry.text; });
  if (!entry.text.empty() && !known) legend.push_back(entry);
}

}  // namespace

Picture draw_plot(const Plot& plot, const PlotConfig& config) {
  std::vector<Series> series;
  for (const Series& one : plot.series) series.push_back(in_order(one));
  Extent x;
  bool has_value = false;
  for (const Series& one : series)
    for (std::size_t i = 0; i < one.x.size(); ++i) {
      x.add(one.x[i]);
      has_value = has_value || std::isfinite(one.y[i]);
    }
  const PlotArea area(config.width_px, config.height_px, linear_axis(x.low, x.high, 8, true),
                      y_axis_of(plot, series));

  Picture picture{config.width_px, config.height_px, {}, plot.y_title + " over " + plot.x_title, {}, {}};
  Svg& svg = picture.svg;
  area.draw_axes(svg, plot.x_title, plot.y_title);
  svg.open_window(area.low_px - Eigen::Vector2d::Constant(2.0),
                  area.high_px + Eigen::Vector2d::Constant(2.0));
  for (const Shade& shade : plot.shades) {
    const double from = area.x_px(shade.from);
    svg.rect({from, area.low_px.y()}, {std::max(area.x_px(shade.to), from + 1.0), area.high_px.y()},
             "band " + std::string(to_string(shade.colour)));
  }
  if (plot.level) {
    const double at = area.y_px(plot.level->at);
    svg.line({area.low_px.x(), at}, {area.high_px.x(), at}, "line dashed ink");
  }
  for (const Series& one : series) draw_series(svg, area, one);
  svg.close();
  if (!has_value) svg.text(0.5 * (area.low_px + area.high_px), "no values", "mid soft");

  for (const Series& one : series) add_once(picture.legend, {one.name, one.mark, one.colour});
  if (plot.level) add_once(picture.legend, {plot.level->name, Mark::dashed, Colour::ink});
  for (const Shade& shade : plot.shades) add_once(picture.legend, {shade.name, Mark::band, shade.colour});
  return picture;
}

}  // namespace beaconless::report
