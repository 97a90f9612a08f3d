// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "beaconless/report/plot.hpp"
#include "beaconless/report/plot_area.hpp"
#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr int kBins = 40;
constexpr double kFarOut_ratio = 1.5;
constexpr double kHeadroom_ratio = 1.4;  // above the highest bar, for the names of the markers
constexpr double kNameRow_px = 24.0;
constexpr double kLetter_px = 10.0;  // of the larger font that a phone shows

/// Up to where values are drawn: the highest, or 1.5 times the 99th percentile where some lie beyond.
double drawn_to(const std::vector<double>& sorted) {
  const double p99 = sorted[static_cast<std::size_t>(0.99 * static_cast<double>(sorted.size() - 1))];
  return p99 > 0.0 ? std::min(sorted.back(), kFarOut_ratio * p99) : sorted.back();
}

/// From the left, each a row lower than the one before, so that no line crosses a name to its left.
void draw_markers(Svg& svg, const PlotArea& area, std::span<const Level> markers) {
  double row = area.low_px.y();
  for (const Level& marker : markers) {
    const double at = area.x_px(marker.at);
    if (!std::isfinite(at)) continue;
    const bool right = at + kLetter_px * static_cast<double>(marker.name.size()) < area.high_px.x();
    svg.line({at, row}, {at, area.high_px.y()}, "line dashed ink");
    svg.text({right ? at + 6.0 : at - 6.0, row + 0.5 * kNameRow_px}, marker.name, right ? "tag" : "tag end",
             TextSide::middle);
    row += kNameRow_px;
  }
}

}  // namespace

Picture draw_histogram(std::span<const double> values, const std::string& x_title, const std::string& what,
                       std::span<const Level> markers, const PlotConfig& config) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double v) { return std::isfinite(v); });
  std::sort(sorted.begin(), sorted.end());
  const double low = sorted.empty() ? 0.0 : sorted.front();
  const double high = sorted.empty() ? 1.0 : drawn_to(sorted);
  const Axis bins = linear_axis(std::min(low, high), high, kBins);
  const double width =
      (bins.high - bins.low) / static_cast<double>(std::max<std::size_t>(bins.ticks.size(), 2) - 1);

  std::vector<std::size_t> counts(bins.ticks.size(), 0);
  std::size_t beyond = 0;
  for (const double value : sorted) {
    const double bin = std::floor((value - bins.low) / width);
    if (value > bins.high || counts.empty())
      ++beyond;
    else
      ++counts[std::min(static_cast<std::size_t>(std::max(bin, 0.0)), counts.size() - 1)];
  }
  const std::size_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  const double room = std::max(1.0, kHeadroom_ratio * static_cast<double>(most));
  Axis y = linear_axis(0.0, room, 5, true);
  std::erase_if(y.ticks,
                [&](const Tick& t) { return t.at != std::floor(t.at) || t.at > static_cast<double>(most); });
  const PlotArea area(config.width_px, config.height_px, linear_axis(bins.low, bins.high, 8, true),
                      std::move(y));

  Picture picture{config.width_px, config.height_px, {}, what + " by " + x_title, {}, {}};
  area.draw_axes(picture.svg, x_title, what + " a bin");
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double from = bins.low + static_cast<double>(i) * width;
    if (counts[i] == 0) continue;
    picture.svg.rect(area(from, static_cast<double>(counts[i])) + Eigen::Vector2d(0.5, 0.0),
                     area(from + width, 0.0), "bar blue");
  }
  draw_markers(picture.svg, area, markers);
  if (sorted.empty()) picture.svg.text(0.5 * (area.low_px + area.high_px), "no values", "mid soft");
  if (beyond > 0)
    picture.note = grouped(beyond) + " of " + grouped(sorted.size()) + " " + what + " lie beyond " +
                   significant(bins.high) + ", up to " + significant(sorted.back()) + ".";
  return picture;
}

}  // namespace beaconless::report
