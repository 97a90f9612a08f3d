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

std::vector<ScanSegment> pieces_by(const Scan& scan, double epsilon_m) {
  return split(scan, segments_by(scan, kShownThreshold_m), {.epsilon_m = epsilon_m});
}

/// A picture of segments alone.
Picture segmented(const Scan& scan, std::vector<ScanSegment> segments, const report::ScanViewConfig& view) {
  report::ScanLayers layers;
  layers.segments = std::move(segments);
  Picture picture = report::draw_scan(scan, layers, view);
  picture.legend = {{fmt::format("{} segments", layers.segments.size()), report::Mark::dots, Colour::blue}};
  return picture;
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

Picture segments_by_threshold(const Scan& scan) {
  return counted("distance threshold D_thd", 0.5, [&](double d) { return segments_by(scan, d).size(); });
}

Picture pieces_by_epsilon(const Scan& scan) {
  return counted("epsilon", 0.5, [&](double epsilon) { return pieces_by(scan, epsilon).size(); });
}

Picture segments_picture(const Scan& scan, double threshold_m, const report::ScanViewConfig& view) {
  return segmented(scan, segments_by(scan, threshold_m), view);
}

Picture pieces_picture(const Scan& scan, double epsilon_m, const report::ScanViewConfig& view) {
  return segmented(scan, pieces_by(scan, epsilon_m), view);
}

Picture dissertation_corners_picture(const Scan& scan, const report::ScanViewConfig& view) {
  report::ScanLayers layers;
  layers.corners = find_corners(scan, corners_of_the_dissertation(), layers.lines);
  return report::draw_scan(scan, layers, view);
}

std::string sweep_picture(const Scan& scan, const DetectorsConfig& config, const std::string& name) {
  constexpr report::ScanViewConfig kSmall{.width_px = 317.0, .max_height_px = 460.0};
  std::vector<TitledPicture> pictures;
  pictures.push_back(
      {"Figure 4.5. " + name + ": segments by distance threshold D_thd", segments_by_threshold(scan)});
  for (const double threshold : {0.05, 0.10, 0.20})
    pictures.push_back({fmt::format("Figure 4.6. Segments by D_thd = {:.2f} m", threshold),
                        segments_picture(scan, threshold, kSmall)});
  for (const double epsilon : {0.05, kShownEpsilon_m, 0.30})
    pictures.push_back({fmt::format("Figure 4.7. Split by epsilon = {:.2f} m", epsilon),
                        pieces_picture(scan, epsilon, kSmall)});
  pictures.push_back(
      {fmt::format(
           "Figure 4.8. Pieces by epsilon of the split (Douglas-Peucker), D_thd = {:.2f} m as in figure 4.7",
           kShownThreshold_m),
       pieces_by_epsilon(scan)});
  pictures.push_back({"Figure 4.9. Corners of least-squares lines, parameters of the dissertation",
                      dissertation_corners_picture(scan, {})});
  pictures.push_back({"The same with the parameters of this run",
                      report::draw_scan(scan, corner_layers(scan, config.corners))});
  return report::svg_sheet(pictures);
}

}  // namespace beaconless::cli
