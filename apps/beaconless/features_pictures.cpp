// SPDX-License-Identifier: Apache-2.0
#include "features_pictures.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "beaconless/features/circles.hpp"
#include "beaconless/features/segment_by_distance.hpp"
#include "beaconless/features/split.hpp"
#include "beaconless/report/plot.hpp"
#include "beaconless/report/scan_view.hpp"

namespace beaconless::cli {
namespace {

using report::Colour;
using report::Picture;
using report::TitledPicture;

constexpr double kShownEpsilon_m = 0.15;  // the dissertation's choice, 4.3
constexpr double kShownThreshold_m = 0.1;

report::ScanLayers corner_layers(const Scan& scan, const CornersConfig& config) {
  report::ScanLayers layers;
  layers.corners = find_corners(scan, config, layers.lines);
  layers.segments = segment_by_distance(scan, config.lines.segmentation);
  layers.circles = find_circles(scan);
  return layers;
}

std::vector<ScanSegment> segments_by(const Scan& scan, double threshold_m) {
  return segment_by_distance(scan, {.threshold = DistanceThreshold::constant, .constant_m = threshold_m});
}

/// Both figures that count segments: by what was varied, 1 cm apart.
template <class Count>
Picture counted(const std::string& what, double most_m, Count count) {
  report::Series series{.name = "segments"};
  for (double threshold = 0.01; threshold <= most_m + 1e-9; threshold += 0.01) {
    series.x.push_back(threshold);
    series.y.push_back(static_cast<double>(count(threshold)));
  }
  return report::draw_plot(
      {.x_title = what + " [m]", .y_title = "segments", .y_low = 0.0, .series = {series}},
      {.width_px = 1000.0});
}

/// A small picture of segments alone; its title says what they are.
TitledPicture segmented(const Scan& scan, std::vector<ScanSegment> segments, const std::string& title) {
  report::ScanLayers layers;
  layers.segments = std::move(segments);
  Picture picture = report::draw_scan(scan, layers, {.width_px = 317.0, .max_height_px = 460.0});
  picture.legend = {{fmt::format("{} segments", layers.segments.size()), report::Mark::dots, Colour::blue}};
  return {title, std::move(picture)};
}

}  // namespace

std::string features_picture(const Scan& scan, std::span<const Detector> wanted,
                             const DetectorsConfig& config, const std::string& name) {
  constexpr std::array kColours{Colour::blue, Colour::orange, Colour::green, Colour::purple};
  std::vector<TitledPicture> pictures;
  for (std::size_t d = 0; d < wanted.size(); ++d) {
    const std::string detector(to_string(wanted[d]));
    report::ScanLayers layers;
    if (wanted[d] == Detector::corners)
      layers = corner_layers(scan, config.corners);
    else
      layers.keypoints.push_back({detector, detect(scan, wanted[d], config), kColours[d % kColours.size()]});
    pictures.push_back({fmt::format("{}: {}", name, detector), report::draw_scan(scan, layers)});
  }
  return report::svg_sheet(pictures);
}

std::string sweep_picture(const Scan& scan, const DetectorsConfig& config, const std::string& name) {
  std::vector<TitledPicture> pictures;
  pictures.push_back(
      {"Figure 4.5. " + name + ": segments by distance threshold D_thd",
       counted("distance threshold D_thd", 0.5, [&](double d) { return segments_by(scan, d).size(); })});
  for (const double threshold : {0.05, 0.10, 0.20})
    pictures.push_back(segmented(scan, segments_by(scan, threshold),
                                 fmt::format("Figure 4.6. Segments by D_thd = {:.2f} m", threshold)));
  const auto first = segments_by(scan, kShownThreshold_m);
  const auto pieces = [&](double epsilon_m) { return split(scan, first, {.epsilon_m = epsilon_m}); };
  for (const double epsilon : {0.05, kShownEpsilon_m, 0.30})
    pictures.push_back(
        segmented(scan, pieces(epsilon), fmt::format("Figure 4.7. Split by epsilon = {:.2f} m", epsilon)));
  pictures.push_back(
      {fmt::format(
           "Figure 4.8. Pieces by epsilon of the split (Douglas-Peucker), D_thd = {:.2f} m as in figure 4.7",
           kShownThreshold_m),
       counted("epsilon", 0.5, [&](double epsilon) { return pieces(epsilon).size(); })});
  report::ScanLayers dissertation;
  dissertation.corners = find_corners(scan, corners_of_the_dissertation(), dissertation.lines);
  pictures.push_back({"Figure 4.9. Corners of least-squares lines, parameters of the dissertation",
                      report::draw_scan(scan, dissertation)});
  pictures.push_back({"The same with the parameters of this run",
                      report::draw_scan(scan, corner_layers(scan, config.corners))});
  return report::svg_sheet(pictures);
}

}  // namespace beaconless::cli
